#include "polyaffine/solve/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace polyaffine {
namespace {

// A force is none where it strains the wall by no more than this, by the tangent stiffness: rounding in a
// stress of a bulk modulus 1e5 times the shear modulus strains it by some 1e-11, and a relative residual of a
// load that is none, or next to none, never falls below its own rounding.
constexpr double kNoStrain = 1e-11;
constexpr double kProgress = 0.9;  // a step with a former tangent is taken where both residuals fall so far

// Residuals of the mixed form at a state.
struct Residual {
  Vector force;                  // R_u of the free unknowns
  std::vector<Vector> pressure;  // κ M⁻¹ R_p of each term, empty without a pressure space
  double relative = 0;           // ‖R_u‖ over the sum of the norms of the terms' forces
  double dilatation = 0;         // largest |M⁻¹ R_p|
  double potential = 0;
  bool admissible = true;
};

// What a Newton step needs of a problem at a load: all that depends on the list of terms.
class Equations {
 public:
  Equations(const EquilibriumProblem& problem, double load) : problem_(problem), load_(load) {}

  bool mixed() const {
    return std::any_of(problem_.terms.begin(), problem_.terms.end(),
                       [](const auto& term) { return term.energy->pressure_space().has_value(); });
  }

  MixedState start(const MixedState& from) const {
    MixedState out = from;
    prescribe(out.c);
    out.pressures.resize(problem_.terms.size());
    for (std::size_t k = 0; k < problem_.terms.size(); ++k) {
      const auto& energy = *problem_.terms[k].energy;
      if (energy.pressure_space() && out.pressures[k].size() == 0) out.pressures[k] = energy.pressure(out.c);
    }
    return out;
  }

  Residual residual(const MixedState& at) const {
    Residual out;
    out.force = Vector::Zero(at.c.size());
    out.pressure.resize(problem_.terms.size());
    double scale = 0;
    each_term([&](std::size_t k, const PotentialTerm& term, double s) {
      const EnergyValue e = term.energy->evaluate(motion(k, at));
      if (term.wall && e.min_det <= 0) out.admissible = false;
      out.potential += s * e.value;
      out.force += s * e.gradient;
      scale += std::abs(s) * e.gradient.norm();
      if (!term.energy->pressure_space()) return;
      out.pressure[k] = term.energy->penalty_pressure(e.pressure_gradient);
      const double kappa = term.energy->pressure_space()->bulk_modulus;
      out.dilatation = std::max(out.dilatation, out.pressure[k].cwiseAbs().maxCoeff() / kappa);
    });
    restrict(out.force);
    const double norm = out.force.norm();
    out.relative = scale > 0 ? norm / scale : 0;
    out.admissible &= std::isfinite(norm) && std::isfinite(out.potential);
    return out;
  }

  // R_u + κ D(c)ᵀM⁻¹R_p of the free unknowns.
  Vector condensed(const Vector& c, const Residual& r) const {
    Vector out = r.force;
    each_term([&](std::size_t k, const PotentialTerm& term, double s) {
      if (r.pressure[k].size() > 0) out += s * term.energy->pressure_force(c, r.pressure[k]);
    });
    restrict(out);
    return out;
  }

  void assemble(const MixedState& at, LinearSystem& system) const {
    system.set_zero();
    each_term([&](std::size_t k, const PotentialTerm& term, double s) {
      term.energy->add_tangent(motion(k, at), system, s);
    });
  }

  // Largest change of a deformation gradient along a step; infinite where no term is a wall.
  double strain(const Vector& step) const {
    std::optional<double> out;
    each_term([&](std::size_t, const PotentialTerm& term, double) {
      if (!term.wall) return;
      const FieldTable& table = term.energy->table();
      for (const PointBlock& block : table.blocks) {
        Matrix change = Matrix::Zero(9, block.count);
        add_field(block, gather(block, step), change.data());
        out = std::max(out.value_or(0), change.cwiseAbs().maxCoeff());
      }
    });
    return out.value_or(std::numeric_limits<double>::infinity());
  }

  MixedState step(const Vector& c, const Residual& r, Vector direction) const {
    MixedState out{std::move(direction), r.pressure};
    each_term([&](std::size_t k, const PotentialTerm& term, double) {
      if (r.pressure[k].size() > 0)
        out.pressures[k] += term.energy->penalty_pressure(term.energy->volume_change(c, out.c));
    });
    return out;
  }

 private:
  template <class Visit>
  void each_term(const Visit& visit) const {
    for (std::size_t k = 0; k < problem_.terms.size(); ++k)
      if (const double s = problem_.terms[k].scale(load_); s != 0) visit(k, problem_.terms[k], s);
  }

  Motion motion(std::size_t k, const MixedState& at) const {
    const auto& p = at.pressures[k];
    return {at.c, problem_.terms[k].state(load_), nullptr, p.size() > 0 ? &p : nullptr};
  }

  void restrict(Vector& force) const {
    for (std::size_t i = 0; i < problem_.fixed.size(); ++i)
      if (problem_.fixed[i]) force[static_cast<Eigen::Index>(i)] = 0;
    if (const auto& p = problem_.projection) force = p->Z * p->reduce(force);
  }

  void prescribe(Vector& c) const {
    if (const auto& p = problem_.projection) c = load_ * p->c0 + p->Z * p->reduce(c);
    for (std::size_t i = 0; i < problem_.fixed.size(); ++i)
      if (problem_.fixed[i]) {
        const auto k = static_cast<Eigen::Index>(i);
        c[k] = problem_.prescribed.size() > 0 ? load_ * problem_.prescribed[k] : 0.0;
      }
  }

  const EquilibriumProblem& problem_;
  double load_;
};

bool converged(const Residual& r, const NewtonOptions& options) {
  return r.relative <= options.tolerance && r.dilatation <= options.dilatation_tolerance;
}

// Whether both residuals fall to a share of their former size, or pass.
bool falls(const Residual& from, const Residual& to, double share, const NewtonOptions& options) {
  return to.admissible && to.relative <= std::max(share * from.relative, options.tolerance) &&
         to.dilatation <= std::max(share * from.dilatation, options.dilatation_tolerance);
}

// Whether the tangent of a step serves another: the residuals fell to the share that is asked for, or pass
// after a few more steps at this pace. A few cost no more than one with factors of its own.
bool serves(const Residual& from, const Residual& to, const NewtonOptions& options) {
  constexpr double kFew = 4;
  if (falls(from, to, options.contraction, options)) return true;
  if (options.contraction == 0 || !falls(from, to, kProgress, options)) return false;
  const auto steps = [](double before, double after, double tolerance) {
    return after <= tolerance ? 0 : std::log(tolerance / after) / std::log(after / before);
  };
  return steps(from.relative, to.relative, options.tolerance) <= kFew &&
         steps(from.dilatation, to.dilatation, options.dilatation_tolerance) <= kFew;
}

MixedState moved(const MixedState& from, double length, const MixedState& step) {
  MixedState out = from;
  out.c += length * step.c;
  for (std::size_t k = 0; k < out.pressures.size(); ++k)
    if (step.pressures[k].size() > 0) out.pressures[k] += length * step.pressures[k];
  return out;
}

// The path continued to a load through its last equilibria, at most three of them (Lagrange).
struct Path {
  std::vector<double> loads;
  std::vector<MixedState> states;

  void add(double load, const MixedState& state) {
    if (loads.size() == 3) {
      loads.erase(loads.begin());
      states.erase(states.begin());
    }
    loads.push_back(load);
    states.push_back(state);
  }
  MixedState at(double load) const {
    MixedState out = states.back();
    for (std::size_t i = 0; i + 1 < loads.size(); ++i) {
      double weight = 1;
      for (std::size_t j = 0; j < loads.size(); ++j)
        if (j != i) weight *= (load - loads[j]) / (loads[i] - loads[j]);
      out = moved(out, weight, difference(states[i], states.back()));
    }
    return out;
  }

 private:
  static MixedState difference(MixedState a, const MixedState& b) { return moved(a, -1, b); }
};

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
    case StopReason::interrupted:
      return "interrupted";
  }
  return "unknown";
}

namespace {

// A start of Newton's method and what it leaves there.
struct Start {
  MixedState state;
  Residual residual;
};
Start start_at(const Equations& equations, const MixedState& state) {
  Start out{equations.start(state), {}};
  out.residual = equations.residual(out.state);
  return out;
}

// `tangent`: the unknowns whose tangent the system holds the factors of, empty without one.
NewtonReport newton_from(const Equations& equations, Start start, LinearSystem& system, Vector& tangent,
                         MixedState& state, const NewtonOptions& options) {
  NewtonReport report;
  MixedState& x = start.state;
  Residual& now = start.residual;
  const auto stop = [&](StopReason reason) {
    report.reason = reason;
    if (reason == StopReason::converged) state = x;
    return report;
  };
  if (!now.admissible) return stop(StopReason::line_search_failed);
  for (;; ++report.iterations) {
    report.residuals.push_back(now.relative);
    if (converged(now, options)) return stop(StopReason::converged);
    if (report.iterations == options.max_iterations) return stop(StopReason::max_iterations);
    if (options.on_iteration) options.on_iteration(report.iterations, now.relative);

    if (tangent.size() > 0 && options.contraction > 0) {
      const Vector direction = -system.solve(equations.condensed(tangent, now));
      MixedState trial = moved(x, 1, equations.step(tangent, now, direction));
      Residual next = equations.residual(trial);
      if (!serves(now, next, options)) tangent.resize(0);
      if (falls(now, next, kProgress, options)) {
        x = std::move(trial);
        now = std::move(next);
        continue;
      }
    }

    tangent.resize(0);
    equations.assemble(x, system);
    if (!system.factorise()) return stop(StopReason::singular_tangent);
    tangent = x.c;
    ++report.tangents;
    report.unstable = !system.positive_definite();
    report.indefinite |= report.unstable;
    const Vector r = equations.condensed(x.c, now);
    const MixedState step = equations.step(x.c, now, -system.solve(r));
    if (now.dilatation <= options.dilatation_tolerance && equations.strain(step.c) <= kNoStrain) {
      x = moved(x, 1, step);
      return stop(StopReason::converged);
    }
    const bool mixed = equations.mixed();
    const double slope = mixed ? 0 : r.dot(step.c);
    const double noise = 1e-14 * std::abs(now.potential);

    double length = 1;
    bool accepted = false;
    for (int shortening = 0; shortening <= options.max_halvings && !accepted; ++shortening) {
      const MixedState trial = moved(x, length, step);
      Residual next = equations.residual(trial);
      double shorter = 0.5;
      if (next.admissible) {
        const double lower = 1 - 1e-4 * length;
        accepted =
            (slope < 0 && next.potential <= now.potential + 1e-4 * length * slope + noise) ||
            (next.force.norm() <= lower * now.force.norm() && next.dilatation <= lower * now.dilatation);
        if (!accepted && mixed) {
          const Vector correction = -system.solve(equations.condensed(x.c, next));
          accepted = correction.norm() <= (1 - length / 4) * step.c.norm();
          const double defect = (correction - (1 - length) * step.c).norm();
          shorter = std::clamp(0.5 * length * step.c.norm() / defect, 0.1, 0.5);
        }
      }
      if (!accepted) {
        length *= shorter;
        continue;
      }
      report.shortened += shortening > 0;
      if (!serves(now, next, options)) tangent.resize(0);
      x = trial;
      now = std::move(next);
    }
    if (!accepted) return stop(StopReason::line_search_failed);
  }
}

}  // namespace

NewtonReport newton(const EquilibriumProblem& problem, double load, LinearSystem& system, MixedState& state,
                    const NewtonOptions& options) {
  const Equations equations(problem, load);
  Vector tangent;
  return newton_from(equations, start_at(equations, state), system, tangent, state, options);
}

NewtonReport newton(const EquilibriumProblem& problem, double load, LinearSystem& system, Vector& c,
                    const NewtonOptions& options) {
  MixedState state{c, {}};
  const NewtonReport report = newton(problem, load, system, state, options);
  if (report.converged()) c = state.c;
  return report;
}

LoadReport load_stepping(const EquilibriumProblem& problem, LinearSystem& system, Vector& c,
                         const LoadOptions& options, double from) {
  constexpr double kTarget = 4;    // tangents a step for which its length is kept
  constexpr double kNearly = 0.1;  // steps may be longer by this share to make the last one no shorter
  constexpr double kBetter = 0.7;  // the last equilibrium is the better start below this share of residual
  LoadReport report;
  report.reached = from;
  double step = options.first_step;
  Vector tangent;
  NewtonOptions on_path = options.newton;
  on_path.tolerance *= options.path_slack;
  on_path.dilatation_tolerance *= options.path_slack;
  MixedState state{c, {}};
  Path path;
  path.add(from, Equations(problem, from).start(state));
  while (report.reached < 1) {
    if (options.interrupted && options.interrupted()) {
      report.reason = StopReason::interrupted;
      return report;
    }
    const double rest = 1 - report.reached;
    const int steps_left = static_cast<int>(std::ceil(rest / step - kNearly));
    const double load = steps_left <= 1 ? 1 : report.reached + std::max(rest / steps_left, 0.75 * step);
    const NewtonOptions& newton_options = load < 1 ? on_path : options.newton;
    const Equations equations(problem, load);
    MixedState trial;
    const auto attempt_from = [&](Start start) {
      const NewtonReport out =
          newton_from(equations, std::move(start), system, tangent, trial, newton_options);
      report.iterations += out.iterations;
      report.tangents += out.tangents;
      return out;
    };
    Start last = start_at(equations, path.states.back()), ahead = last;
    if (report.steps > 0) ahead = start_at(equations, path.at(load));
    const bool extrapolate = report.steps > 0 && ahead.residual.admissible &&
                             last.residual.relative >= kBetter * ahead.residual.relative;
    NewtonReport attempt = attempt_from(extrapolate ? std::move(ahead) : last);
    if (!attempt.converged() && extrapolate) attempt = attempt_from(std::move(last));
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
    const double last_step = load - report.reached;
    if (attempt.unstable && !report.unstable_from) report.unstable_from = load;
    path.add(load, trial);
    c = trial.c;
    report.reached = load;
    if (options.on_step) options.on_step(load, c);
    step = std::min(options.largest_step,
                    last_step * std::clamp(kTarget / std::max(1, attempt.tangents), 0.5, 2.0));
  }
  return report;
}

}  // namespace polyaffine
