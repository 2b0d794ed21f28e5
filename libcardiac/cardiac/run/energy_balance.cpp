#include "cardiac/run/energy_balance.hpp"

#include <utility>

#include <cardiac/run/active_tension.hpp>
#include <polyaffine/kinematics/packed_field.hpp>
#include <polyaffine/system/point_stress.hpp>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

constexpr double kMicrojoule = 1e-3;  // mJ

polyaffine::PointState as_state(const Vector& tension) {
  return {tension.data(), static_cast<std::size_t>(tension.size())};
}

// The derivative at `at` of the parabola through three states.
Vector rate_at(double at, const HeartState& a, const HeartState& b, const HeartState& c) {
  const auto slope = [at](double own, double other, double third) {
    return (2 * at - other - third) / ((own - other) * (own - third));
  };
  return slope(a.time_ms, b.time_ms, c.time_ms) * a.c + slope(b.time_ms, a.time_ms, c.time_ms) * b.c +
         slope(c.time_ms, a.time_ms, b.time_ms) * c.c;
}

// −∫ p dV of all cavities; none of a wall without a cavity, which is told without a volume.
double work_on_blood(const std::vector<HeartState>& steps) {
  if (!steps.front().volumes_mm3.allFinite()) return 0;
  double sum = 0;
  for (std::size_t n = 1; n < steps.size(); ++n) {
    const Vector change = steps[n].volumes_mm3 - steps[n - 1].volumes_mm3;
    sum -= 0.5 * (steps[n].pressures_kPa + steps[n - 1].pressures_kPa).dot(change);
  }
  return sum;
}

double stored(const polyaffine::Terms& terms, const Vector& c, const Vector& rate) {
  double sum = 0;
  for (const auto& term : terms) sum += term->stored_energy({0, c, &rate});
  return sum;
}

// Adds what the wall's own stress and the dashpots do between the steps.
void add_steps(const Ventricle& ventricle, const HeartPath& path, EnergyBalance& out) {
  const polyaffine::FieldEnergy& wall = *ventricle.wall;
  const Vector& weights = wall.table().weights;
  const auto active_stress = [&](const HeartState& state, const Matrix& F) {
    const Vector tension = active_tension(ventricle, path, state);
    return polyaffine::driven_stress(ventricle.active(), F, as_state(tension));
  };
  const polyaffine::PackedField deformation(wall.table());
  Matrix F = deformation.at(path.steps.front().c);
  Matrix active = active_stress(path.steps.front(), F);
  for (std::size_t n = 1; n < path.steps.size(); ++n) {
    const HeartState &before = path.steps[n - 1], &now = path.steps[n];
    const double lasts = now.time_ms - before.time_ms;
    Matrix next = deformation.at(now.c);
    Matrix next_active = active_stress(now, next);
    const Matrix change = next - F;
    out.active_mJ -= kMicrojoule / 2 * polyaffine::work(weights, active + next_active, change);
    if (wall.feels_rate())
      out.viscosity_mJ +=
          kMicrojoule *
          polyaffine::work(weights, polyaffine::viscous_stress(wall, (F + next) / 2, change / lasts), change);
    const Vector middle = (before.c + now.c) / 2, rate = (now.c - before.c) / lasts;
    for (const auto& support : ventricle.supports)
      out.dashpots_mJ +=
          kMicrojoule * lasts * support->dissipation({path.beat_start_ms + now.time_ms, middle, &rate});
    F = std::move(next);
    active = std::move(next_active);
  }
}

}  // namespace

std::optional<EnergyBalance> energy_balance(const Ventricle& ventricle, const scene::Time& time,
                                            const HeartPath& path) {
  if (!ventricle.contraction || path.steps.size() < 3) return {};
  EnergyBalance out;
  out.cavities_mJ = kMicrojoule * work_on_blood(path.steps);
  add_steps(ventricle, path, out);
  const auto n = path.steps.size();
  const HeartState &begin = path.steps.front(), &end = path.steps.back();
  const Vector begin_rate = rate_at(begin.time_ms, begin, path.steps[1], path.steps[2]);
  const Vector end_rate = rate_at(end.time_ms, path.steps[n - 3], path.steps[n - 2], end);
  out.elastic_mJ = kMicrojoule * (polyaffine::elastic_energy(*ventricle.wall, end.c) -
                                  polyaffine::elastic_energy(*ventricle.wall, begin.c));
  out.supports_mJ = kMicrojoule * (stored(ventricle.supports, end.c, end_rate) -
                                   stored(ventricle.supports, begin.c, begin_rate));
  polyaffine::System moving;
  moving.layout.add({.name = "displacement", .unit = "mm", .solved = polyaffine::Solved::field},
                    ventricle.num_coefficients());
  add_states(ventricle, time, moving);
  out.kinetic_mJ =
      kMicrojoule * (stored(moving.terms, end.c, end_rate) - stored(moving.terms, begin.c, begin_rate));
  return out;
}

}  // namespace cardiac
