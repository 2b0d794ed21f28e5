#include "cardiac/run/verification.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iomanip>
#include <sstream>

#include <cardiac/strain/segment_strain.hpp>
#include <cardiac/training/tuned_model.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/nested_basis.hpp>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Points;
using polyaffine::Vector;

namespace {

struct Comparison {
  Matrix F_reduced, F_full;  // at the integration points of the full-order model
  double displacement_error = 0, volume_error = 0;
};

// Of Newton's method in an instant; how many it takes is not known before.
constexpr double kUsualSteps = 15;

TrainingLoad load_of(const HeartState& state, double clock_ms) {
  TrainingLoad out;
  out.pressures_kPa = state.pressures_kPa;
  out.clock_ms = clock_ms;
  return out;
}

// The truth under the load of a state: from the state itself where its model knows pressures of elements
// (others would start from wild ones), else from the truth before it, or raised from zero.
FullState truth_of(const TrainingLoad& load, const HeartState& state, const Ventricle& reduced,
                   FullOrder& full, const std::optional<FullState>& before) {
  std::optional<FullState> out;
  if (reduced.tuned) {
    FullState guess{
        load, dynamic_cast<const polyaffine::NestedBasis&>(*reduced.discretisation.basis).nodal(state.c), {}};
    if (reduced.wall->pressure_space())
      guess.pressure = reduced.tuned->space.pressures.transpose() * reduced.wall->pressure(state.c);
    out = full.solve(load, &guess);
  } else {
    out = before ? full.follow(load, *before) : full.solve(load, nullptr);
  }
  if (!out)
    throw polyaffine::ComputationError("verification: the full-order model has no equilibrium at " +
                                       load.name);
  return *out;
}

Comparison compare(const Ventricle& reduced, const FullOrder& order, const HeartState& state,
                   const Vector& c) {
  const Ventricle full = order.ventricle({});
  const auto& elements = dynamic_cast<const polyaffine::LagrangeBasis&>(*full.discretisation.basis);
  const auto& points = full.discretisation.points;
  Comparison out;
  out.F_full = polyaffine::evaluate_field(full.wall->table(), c);
  out.F_reduced = polyaffine::evaluate_field(
      polyaffine::deformation_table(*reduced.discretisation.basis, points), state.c);
  const Points u = polyaffine::DisplacementMap(elements, points.tet, points.barycentric).apply(c);
  const Points v = polyaffine::DisplacementMap(*reduced.discretisation.basis, points.tet, points.barycentric)
                       .apply(state.c);
  const Vector error = (u - v).colwise().squaredNorm();
  const Vector norm = u.colwise().squaredNorm();
  const double size = points.weights.dot(norm);
  // Displacements below this share of the wall's size are rounding, as without a load.
  constexpr double kNone = 1e-9;
  const double volume = points.weights.sum();
  out.displacement_error =
      size > kNone * kNone * std::pow(volume, 5.0 / 3) ? std::sqrt(points.weights.dot(error) / size) : 0;
  for (std::size_t k = 0; k < full.cavities.size(); ++k) {
    const double off = reduced.cavity_volume(state.c, k) / full.cavity_volume(c, k) - 1;
    if (std::abs(off) > std::abs(out.volume_error)) out.volume_error = off;
  }
  return out;
}

}  // namespace

std::vector<VerificationInstant> verify_path(const Ventricle& reduced, const Scene& scene,
                                             const HeartPath& path, const Progress& progress) {
  const auto tell = [&](const std::string& what, double fraction) {
    if (progress) progress(what, fraction);
  };
  tell("full order: elements", 0);
  const KeyStates key = key_states(path, scene);
  FullOrder full(reduced.anatomy, scene);
  const SegmentGauge gauge(*reduced.anatomy->coordinates, full.discretisation().points);
  std::vector<VerificationInstant> out;
  std::optional<FullState> truth;
  Matrix F_reduced_ed, F_full_ed;
  for (const auto& [name, instant_state] : {std::pair{"ED", &key.ed}, std::pair{"ES", &key.es}}) {
    const HeartState& state = *instant_state;
    const auto start = std::chrono::steady_clock::now();
    int steps = 0;
    full.watch = [&, at = std::string(name), done = static_cast<double>(out.size())](int iteration,
                                                                                     double residual) {
      std::ostringstream what;
      what << "full order at " << at << ": Newton step " << iteration + 1 << ", residual "
           << std::setprecision(1) << residual;
      ++steps;
      tell(what.str(), (done + steps / (steps + kUsualSteps)) / 2);
    };
    TrainingLoad load = load_of(state, path.beat_start_ms + state.time_ms);
    load.name = name;
    truth = truth_of(load, state, reduced, full, truth);
    const Comparison at = compare(reduced, full, state, truth->u);
    if (out.empty()) {
      F_reduced_ed = at.F_reduced;
      F_full_ed = at.F_full;
      if (!scene.contraction)
        F_reduced_ed = F_full_ed = polyaffine::Mat3::Identity().reshaped().replicate(1, F_full_ed.cols());
    }
    // At end diastole the strain is that of the filling, against the reference configuration.
    const Matrix rest = polyaffine::Mat3::Identity().reshaped().replicate(1, F_full_ed.cols());
    const auto a = gauge.strain(at.F_reduced, out.empty() ? rest : F_reduced_ed);
    const auto b = gauge.strain(at.F_full, out.empty() ? rest : F_full_ed);
    VerificationInstant instant;
    instant.instant = name;
    instant.time_ms = state.time_ms;
    instant.displacement_error_percent = 100 * at.displacement_error;
    instant.volume_error_percent = 100 * at.volume_error;
    instant.wall_time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (std::size_t k = 0; k < a.size(); ++k)
      instant.max_segment_strain_error = std::max(
          {instant.max_segment_strain_error, std::abs(a[k].longitudinal - b[k].longitudinal),
           std::abs(a[k].circumferential - b[k].circumferential), std::abs(a[k].radial - b[k].radial)});
    out.push_back(instant);
  }
  return out;
}

}  // namespace cardiac
