#include "polyaffine/solve/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polyaffine {
namespace {

struct State {
  double potential = 0;
  double force_scale = 0;  // sum of the norms of the terms' forces
  double residual = 0;     // relative
  Vector gradient;
  bool admissible = true;
};

State evaluate(const EquilibriumProblem& problem, double load, const Vector& c) {
  State out;
  out.gradient = Vector::Zero(c.size());
  for (const auto& term : problem.terms) {
    const double s = term.scale(load);
    if (s == 0) continue;
    const EnergyValue e = term.energy->evaluate({c, term.state(load)});
    if (term.wall && e.min_det <= 0) out.admissible = false;
    out.potential += s * e.value;
    out.gradient += s * e.gradient;
    out.force_scale += std::abs(s) * e.gradient.norm();
  }
  for (std::size_t i = 0; i < problem.fixed.size(); ++i)
    if (problem.fixed[i]) out.gradient[static_cast<Eigen::Index>(i)] = 0;
  if (problem.projection) out.gradient = problem.projection->Z * problem.projection->reduce(out.gradient);
  const double norm = out.gradient.norm();
  out.admissible &= std::isfinite(norm) && std::isfinite(out.potential);
  out.residual = out.force_scale > 0 ? norm / out.force_scale : 0;
  return out;
}

void prescribe(const EquilibriumProblem& problem, double load, Vector& c) {
  if (const auto& p = problem.projection) c = load * p->c0 + p->Z * p->reduce(c);
  for (std::size_t i = 0; i < problem.fixed.size(); ++i)
    if (problem.fixed[i]) {
      const auto k = static_cast<Eigen::Index>(i);
      c[k] = problem.prescribed.size() > 0 ? load * problem.prescribed[k] : 0.0;
    }
}

}  // namespace

std::string to_string(StopReason reason) {
  switch (reason) {
    case StopReason::converged:
      return "converged";
    case StopReason::max_iterations:
      return "too many Newton iterations";
    case StopReason::line_search_failed:
      return "no step along the Newton direction lowers the residual";
    case StopReason::singular_tangent:
      return "the tangent stiffness is singular";
    case StopReason::step_too_small:
      return "the load step became too small";
  }
  return "unknown";
}

NewtonReport newton(const EquilibriumProblem& problem, double load, LinearSystem& system, Vector& c,
                    const NewtonOptions& options) {
  NewtonReport report;
  Vector x = c;
  prescribe(problem, load, x);
  State now = evaluate(problem, load, x);
  const auto stop = [&](StopReason reason) {
    report.reason = reason;
    if (reason == StopReason::converged) c = x;
    return report;
  };
  if (!now.admissible) return stop(StopReason::line_search_failed);
  for (;; ++report.iterations) {
    report.residuals.push_back(now.residual);
    if (now.residual <= options.tolerance) return stop(StopReason::converged);
    if (report.iterations == options.max_iterations) return stop(StopReason::max_iterations);

    system.set_zero();
    for (const auto& term : problem.terms)
      if (const double s = term.scale(load); s != 0)
        term.energy->add_tangent({x, term.state(load)}, system, s);
    if (!system.factorise()) return stop(StopReason::singular_tangent);
    report.indefinite |= !system.positive_definite();
    const Vector step = -system.solve(now.gradient);
    const double slope = now.gradient.dot(step);

    double length = 1;
    bool accepted = false;
    for (int halving = 0; halving <= options.max_halvings && !accepted; ++halving, length /= 2) {
      const Vector trial_x = x + length * step;
      State trial = evaluate(problem, load, trial_x);
      const double noise = 1e-14 * std::abs(now.potential);
      const bool lower_energy = slope < 0 && trial.potential <= now.potential + 1e-4 * length * slope + noise;
      const bool lower_residual = trial.gradient.norm() <= (1 - 1e-4 * length) * now.gradient.norm();
      if (!trial.admissible || (!lower_energy && !lower_residual)) continue;
      report.shortened += halving > 0;
      x = trial_x;
      now = std::move(trial);
      accepted = true;
    }
    if (!accepted) return stop(StopReason::line_search_failed);
  }
}

LoadReport load_stepping(const EquilibriumProblem& problem, LinearSystem& system, Vector& c,
                         const LoadOptions& options, double from) {
  constexpr int kQuick = 4;  // Newton iterations up to which the next step is longer
  LoadReport report;
  report.reached = from;
  double step = options.first_step;
  double last_step = 0;
  Vector previous = c;
  while (report.reached < 1) {
    const double load = std::min(1.0, report.reached + step);
    Vector trial = c;
    if (last_step > 0) trial += (load - report.reached) / last_step * (c - previous);
    NewtonReport attempt = newton(problem, load, system, trial, options.newton);
    report.iterations += attempt.iterations;
    if (!attempt.converged() && last_step > 0) {  // the extrapolated start may be inadmissible
      trial = c;
      attempt = newton(problem, load, system, trial, options.newton);
      report.iterations += attempt.iterations;
    }
    report.last = attempt;
    if (!attempt.converged()) {
      ++report.cuts;
      step = (load - report.reached) / 2;
      if (step < options.smallest_step) {
        report.reason = StopReason::step_too_small;
        return report;
      }
      continue;
    }
    ++report.steps;
    last_step = load - report.reached;
    previous = c;
    c = trial;
    report.reached = load;
    if (options.on_step) options.on_step(load, c);
    if (attempt.iterations <= kQuick) step = std::min(options.largest_step, 2 * last_step);
  }
  return report;
}

}  // namespace polyaffine
