#include "cardiac/run/verification.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iomanip>
#include <sstream>

#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/strain/segment_strain.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/solve/load_stepping.hpp>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Points;
using polyaffine::Vector;

namespace {

// Values of the reduced displacement at the nodes of the elements: their coefficients.
Vector nodal_displacement(const polyaffine::LagrangeBasis& elements, const polyaffine::Basis& reduced,
                          const Vector& c) {
  std::vector<int> tet(elements.num_functions());
  Eigen::Matrix4Xd barycentric(4, elements.num_functions());
  const Eigen::Matrix4Xd corners = elements.node_barycentric();
  for (int t = 0; t < static_cast<int>(elements.elements().cols()); ++t)
    for (Eigen::Index k = 0; k < corners.cols(); ++k) {
      tet[elements.elements()(k, t)] = t;
      barycentric.col(elements.elements()(k, t)) = corners.col(k);
    }
  return polyaffine::DisplacementMap(reduced, tet, barycentric).apply(c).reshaped();
}

struct Comparison {
  Matrix F_reduced, F_full;  // at the integration points of the full-order model
  double displacement_error = 0, volume_error = 0, wall_time = 0;
};

// Told with the share of one instant's solution that is done.
using InstantProgress = std::function<void(const std::string& what, double fraction)>;

std::function<void(int, double)> newton_progress(const InstantProgress& progress, double tolerance) {
  return [&progress, tolerance, first = 0.0](int iteration, double residual) mutable {
    if (iteration == 0) first = residual;
    const double decades = first > tolerance ? std::log(first / residual) / std::log(first / tolerance) : 0;
    std::ostringstream what;
    what << "Newton step " << iteration + 1 << ", residual " << std::setprecision(1) << residual;
    progress(what.str(), std::clamp(decades, 0.0, 1.0));
  };
}

Comparison compare(const Ventricle& reduced, const Ventricle& full, const HeartState& state, double clock_ms,
                   const InstantProgress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const auto& elements = dynamic_cast<const polyaffine::LagrangeBasis&>(*full.discretisation.basis);
  const auto& points = full.discretisation.points;
  const Vector tension = full.contraction ? full.contraction->tension(clock_ms) : Vector();
  const polyaffine::System problem = loaded_ventricle(full, {state.pressures_kPa, tension});
  const auto linear = problem.make_linear();
  Vector c = nodal_displacement(elements, *reduced.discretisation.basis, state.c);
  polyaffine::NewtonOptions options;
  options.tolerance = 1e-7;
  options.max_iterations = 60;
  options.on_iteration = newton_progress(progress, options.tolerance);
  auto report = polyaffine::newton(problem, 1, *linear, c, options);
  if (!report.converged()) {
    c.setZero();
    double reached = 0;
    polyaffine::LoadOptions steps;
    steps.on_step = [&](double load, const Vector&) { reached = load; };
    steps.newton.on_iteration = [&](int, double) { progress("load raised from zero", reached); };
    const auto ramp = polyaffine::load_stepping(problem, *linear, c, steps);
    if (!ramp.converged())
      throw polyaffine::ComputationError("verification: the full-order problem stopped at " +
                                         std::to_string(100 * ramp.reached) +
                                         " % of the load: " + polyaffine::to_string(ramp.last.reason));
  }
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
  out.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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
  const Ventricle full = build_ventricle(reduced.anatomy, scene, scene::Method::fem);
  const SegmentGauge gauge(*reduced.anatomy->coordinates, full.discretisation.points);
  std::vector<VerificationInstant> out;
  Matrix F_reduced_ed, F_full_ed;
  for (const auto& [name, instant_state] : {std::pair{"ED", &key.ed}, std::pair{"ES", &key.es}}) {
    const HeartState& state = *instant_state;
    const auto done = static_cast<double>(out.size());
    const InstantProgress at_instant = [&, instant = std::string(name)](const std::string& what,
                                                                        double share) {
      tell("full order at " + instant + ": " + what, (done + share) / 2);
    };
    const Comparison at = compare(reduced, full, state, path.beat_start_ms + state.time_ms, at_instant);
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
    instant.wall_time_s = at.wall_time;
    for (std::size_t k = 0; k < a.size(); ++k)
      instant.max_segment_strain_error = std::max(
          {instant.max_segment_strain_error, std::abs(a[k].longitudinal - b[k].longitudinal),
           std::abs(a[k].circumferential - b[k].circumferential), std::abs(a[k].radial - b[k].radial)});
    out.push_back(instant);
  }
  return out;
}

}  // namespace cardiac
