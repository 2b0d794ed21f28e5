#include "polyaffine/solve/newton.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace polyaffine {
namespace {

// A force is none where it strains the solid by no more than this, by the tangent stiffness: rounding in a
// stress of a bulk modulus 1e5 times the shear modulus strains it by some 1e-11, and a relative residual of a
// load that is none, or next to none, never falls below its own rounding.
constexpr double kNoStrain = 1e-11;
constexpr double kProgress = 0.9;  // a step with a former tangent is taken where both residuals fall so far
constexpr double kArmijo = 1e-4;  // share of the expected fall that a step must bring (Nocedal & Wright 2006)
constexpr double kRounding = 1e-14;  // of a potential, relative

bool passes(const RestState& at, const NewtonOptions& options) {
  return at.relative <= options.tolerance && at.residual.defect <= options.defect_tolerance;
}

// Whether both residuals fall to a share of their former size, or pass.
bool falls(const RestState& from, const RestState& to, double share, const NewtonOptions& options) {
  return to.residual.admissible() && to.relative <= std::max(share * from.relative, options.tolerance) &&
         to.residual.defect <= std::max(share * from.residual.defect, options.defect_tolerance);
}

// Whether the tangent of a step serves another: the residuals fell to the share that is asked for, or pass
// after a few more steps at this pace. A few cost no more than one with factors of its own.
bool serves(const RestState& from, const RestState& to, const NewtonOptions& options) {
  constexpr double kFew = 4;
  if (falls(from, to, options.contraction, options)) return true;
  if (options.contraction == 0 || !falls(from, to, kProgress, options)) return false;
  const auto steps = [](double before, double after, double tolerance) {
    return after <= tolerance ? 0 : std::log(tolerance / after) / std::log(after / before);
  };
  return steps(from.relative, to.relative, options.tolerance) <= kFew &&
         steps(from.residual.defect, to.residual.defect, options.defect_tolerance) <= kFew;
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
    case StopReason::interrupted:
      return "interrupted";
  }
  return "unknown";
}

RestState rest_state(const System& system, double t, Vector y) {
  RestState out{std::move(y), {}, 0};
  out.residual = system.residual({t, out.y});
  const double norm = system.layout.field().of(out.residual.values).norm();
  out.relative = out.residual.forces > 0 ? norm / out.residual.forces : 0;
  return out;
}

// One solution: the state now, and the steps that lead from it.
class Newton::Run {
 public:
  Run(Newton& newton, double t, RestState from, const NewtonOptions& options)
      : newton_(newton), t_(t), now_(std::move(from)), options_(options) {}

  NewtonReport solve(Vector& y) {
    report_.reason = now_.residual.admissible() ? iterate() : StopReason::line_search_failed;
    if (report_.converged()) y = now_.y;
    return report_;
  }

 private:
  StopReason iterate() {
    for (;; ++report_.iterations) {
      report_.residuals.push_back(now_.relative);
      if (passes(now_, options_)) return StopReason::converged;
      if (report_.iterations == options_.max_iterations) return StopReason::max_iterations;
      if (options_.on_iteration) options_.on_iteration(report_.iterations, now_.relative);
      if (newton_.has_tangent_ && options_.contraction > 0 && step_with_former_tangent()) continue;
      if (!take_tangent()) return StopReason::singular_tangent;
      const Vector step = correction(now_);
      if (now_.residual.defect <= options_.defect_tolerance && strain(step) <= kNoStrain) {
        now_.y += step;
        return StopReason::converged;
      }
      if (!search_along(step)) return StopReason::line_search_failed;
    }
  }

  // Simplified Newton: the step with the factors that are there, if it helps.
  bool step_with_former_tangent() {
    RestState next = rest_state(newton_.system_, t_, now_.y + correction(now_));
    newton_.has_tangent_ = serves(now_, next, options_);
    if (!falls(now_, next, kProgress, options_)) return false;
    now_ = std::move(next);
    return true;
  }

  bool take_tangent() {
    newton_.has_tangent_ = newton_.linearised_.factorise({t_, now_.y}, 0);
    if (!newton_.has_tangent_) return false;
    ++report_.tangents;
    report_.unstable = !newton_.linearised_.positive_definite();
    report_.indefinite |= report_.unstable;
    return true;
  }

  Vector correction(const RestState& at) {
    Vector step;
    newton_.linearised_.solve({t_, at.y}, -at.residual.values, step);
    return step;
  }

  // The largest change of a deformation gradient along a step; infinite without a solid.
  double strain(const Vector& step) const {
    std::optional<double> out;
    for (const auto& term : newton_.system_.terms)
      if (const auto own = term->strain(step)) out = std::max(out.value_or(0), *own);
    return out.value_or(std::numeric_limits<double>::infinity());
  }

  bool search_along(const Vector& step) {
    const Unknowns c = newton_.system_.layout.field();
    // With unknowns beside the field the solution is a saddle point, and no potential falls towards it.
    const bool saddle = newton_.system_.size() > c.size;
    const double slope = saddle ? 0 : now_.residual.values.dot(step);
    double length = 1;
    for (int shortening = 0; shortening <= options_.max_halvings; ++shortening) {
      RestState next = rest_state(newton_.system_, t_, now_.y + length * step);
      double shorter = 0.5;
      if (next.residual.admissible()) {
        bool accepted = potential_falls(next, length * slope) || residuals_fall(next, length);
        if (!accepted && saddle) {
          // With e the next correction, a step of this length is good where ‖e‖ is clearly below ‖step‖.
          const Vector whole = c.of(step), e = c.of(correction(next));
          accepted = e.norm() <= (1 - length / 4) * whole.norm();
          const double defect = (e - (1 - length) * whole).norm();
          shorter = std::clamp(0.5 * length * whole.norm() / defect, 0.1, 0.5);
        }
        if (accepted) {
          report_.shortened += shortening > 0;
          newton_.has_tangent_ = serves(now_, next, options_);
          now_ = std::move(next);
          return true;
        }
      }
      length *= shorter;
    }
    newton_.has_tangent_ = false;
    return false;
  }

  bool potential_falls(const RestState& next, double expected) const {
    const double noise = kRounding * std::abs(now_.residual.potential);
    return expected < 0 && next.residual.potential <= now_.residual.potential + kArmijo * expected + noise;
  }

  bool residuals_fall(const RestState& next, double length) const {
    const Unknowns c = newton_.system_.layout.field();
    const double share = 1 - kArmijo * length;
    return c.of(next.residual.values).norm() <= share * c.of(now_.residual.values).norm() &&
           next.residual.defect <= share * now_.residual.defect;
  }

  Newton& newton_;
  double t_;
  RestState now_;
  const NewtonOptions& options_;
  NewtonReport report_;
};

NewtonReport Newton::solve(double t, RestState from, Vector& y, const NewtonOptions& options) {
  return Run(*this, t, std::move(from), options).solve(y);
}

Vector mixed_start(const System& mixed, double t, const Vector& c) {
  Vector y = Vector::Zero(mixed.size());
  mixed.layout.field().of(y) = c;
  mixed.prescribe(t, y);
  for (const auto& term : mixed.terms) term->start(y);
  return y;
}

NewtonReport newton(const System& system, double t, LinearSystem& linear, Vector& c,
                    const NewtonOptions& options) {
  const System mixed = mixed_form(system);
  Newton solver(mixed, linear);
  Vector y;
  const NewtonReport report = solver.solve(t, rest_state(mixed, t, mixed_start(mixed, t, c)), y, options);
  if (report.converged()) c = mixed.layout.field().of(y);
  return report;
}

}  // namespace polyaffine
