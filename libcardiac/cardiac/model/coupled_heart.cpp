#include "cardiac/model/coupled_heart.hpp"

#include <Eigen/LU>
#include <stdexcept>
#include <utility>

#include <cardiac/core/units.hpp>
#include <cardiac/model/cavity_coupling.hpp>
#include <cardiac/model/circulation_term.hpp>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Unknowns;
using polyaffine::Vector;

namespace {

constexpr double kVolumeTolerance_mm3 = 0.01 * mm3_per_mL;  // a thousandth of what the tables tell of volumes
constexpr double kFlowTolerance_mm3_per_ms = 0.1 * flow_per_mL_per_s;  // and of flows

// So large that the elastic part of K + αC does not count, 1/ms.
constexpr double kViscousAlpha = 1e8;
constexpr int kMostIterations = 50;
constexpr double kRounding = 1e-14;  // of the pressures, relative

// The states of the circulation behind the volumes of its cavities, one block a kind.
void add_vessels(const CirculationModel& circulation, double pressure_tolerance,
                 polyaffine::StateLayout& layout, Unknowns& vessels) {
  vessels = {layout.size(), 0};
  const auto [pressures, volumes, flows] = circulation.kinds();
  const auto add = [&](const char* name, const char* unit, double tolerance, int size) {
    if (size == 0) return;
    layout.add({.name = name, .unit = unit, .absolute_tolerance = tolerance}, size);
    vessels.size += size;
  };
  add("vessel pressures", "kPa", pressure_tolerance, pressures);
  add("chamber volumes", "mm3", kVolumeTolerance_mm3, volumes);
  add("vessel flows", "mm3/ms", kFlowTolerance_mm3_per_ms, flows);
}

}  // namespace

CoupledHeart couple(const Ventricle& ventricle, std::shared_ptr<const CirculationModel> circulation,
                    const scene::Time& time) {
  const int cavities = circulation->num_cavities();
  if (cavities != std::ssize(ventricle.cavities))
    throw std::invalid_argument("couple: the circulation and the wall differ in their number of cavities");
  CoupledHeart out;
  out.system = wall_system(ventricle, ventricle.tension(), time.absolute_tolerance_mm);
  polyaffine::StateLayout& layout = out.system.layout;
  out.displacement = layout.field();
  add_states(ventricle, time, out.system);
  const double pressure_tolerance = time.absolute_tolerance_kPa;
  out.volumes = layout.add(
      {.name = "cavity volumes", .unit = "mm3", .absolute_tolerance = kVolumeTolerance_mm3}, cavities);
  add_vessels(*circulation, pressure_tolerance, layout, out.vessels);
  out.pressures = layout.add({.name = "cavity pressures",
                              .unit = "kPa",
                              .absolute_tolerance = pressure_tolerance,
                              .error_tested = false},
                             cavities);
  for (int k = 0; k < cavities; ++k)
    out.system.terms.push_back(std::make_shared<CavityCoupling>(
        ventricle.cavities[static_cast<std::size_t>(k)].volume, Unknowns{out.volumes.first + k, 1},
        Unknowns{out.pressures.first + k, 1}));
  out.system.terms.push_back(
      std::make_shared<CirculationTerm>(circulation, out.volumes, out.vessels, out.pressures));
  out.circulation = std::move(circulation);
  return out;
}

Vector CoupledHeart::states(const Vector& y) const {
  Vector out(volumes.size + vessels.size);
  out << volumes.of(y), vessels.of(y);
  return out;
}

Vector CoupledHeart::pack(const HeartState& state) const {
  Vector y = Vector::Zero(system.size());
  displacement.of(y) = state.c;
  volumes.of(y) = state.volumes_mm3;
  vessels.of(y) = state.vessels_kPa;
  pressures.of(y) = state.pressures_kPa;
  return y;
}

HeartState CoupledHeart::unpack(double time_ms, const Vector& y) const {
  return {time_ms,         displacement.of(y), volumes.of(y),
          pressures.of(y), vessels.of(y),      muscle_tension(system, y)};
}

polyaffine::SystemCost make_consistent(const CoupledHeart& heart, polyaffine::LinearSystem& linear, double t,
                                       Vector& y, Vector& rate) {
  const int m = heart.num_cavities();
  const auto circulate = [&] { return heart.circulation->rates(t, heart.states(y), heart.pressures.of(y)); };
  heart.vessels.of(rate) = circulate().values.tail(heart.vessels.size);
  polyaffine::Linearised viscous(heart.system, linear);
  if (!viscous.factorise({t, y, &rate}, kViscousAlpha)) return viscous.cost();
  Matrix Z(heart.displacement.size, m), gradient(heart.displacement.size, m);  // of the volumes
  for (int k = 0; k < m; ++k) {
    Z.col(k) = -kViscousAlpha * viscous.response(heart.pressures.first + k);
    gradient.col(k) = -viscous.row(heart.volumes.first + k);
  }
  const Matrix compliance = gradient.transpose() * Z;
  const Vector moving = heart.volumes.of(rate);
  Vector delta = Vector::Zero(m);
  for (int k = 0; k < kMostIterations; ++k) {
    const auto flows = circulate();
    const Vector step = (compliance - flows.by_pressures.topRows(m))
                            .partialPivLu()
                            .solve(Vector(compliance * delta + moving - flows.values.head(m)));
    delta -= step;
    heart.pressures.of(y) -= step;
    if (step.norm() <= kRounding * heart.pressures.of(y).norm()) break;
  }
  heart.displacement.of(rate) += Z * delta;
  heart.volumes.of(rate) += compliance * delta;
  heart.vessels.of(rate) = circulate().values.tail(heart.vessels.size);
  return viscous.cost();
}

}  // namespace cardiac
