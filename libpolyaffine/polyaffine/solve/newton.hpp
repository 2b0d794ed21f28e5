#pragma once

#include <functional>
#include <string>
#include <vector>

#include <polyaffine/system/linearised.hpp>

namespace polyaffine {

struct NewtonOptions {
  /// On ‖residual‖ over Σ ‖force‖ of the terms, or a step of strain below 1e-11.
  double tolerance = 1e-8;
  double defect_tolerance = 1e-8;  ///< on Residual::defect, the largest change of a volume
  int max_iterations = 25;
  int max_halvings = 12;
  /// A tangent and its factors serve further steps, those of a next load included, while each lowers both
  /// residuals to this share or they would pass after four more such steps (simplified Newton, Deuflhard
  /// 2011, §2.1.2); 0: every step has its own.
  double contraction = 0;
  std::function<void(int iteration, double residual)> on_iteration{};  ///< called before each step; may throw
};

enum class StopReason {
  converged,
  max_iterations,
  line_search_failed,
  singular_tangent,
  step_too_small,
  interrupted
};
std::string to_string(StopReason reason);

struct NewtonReport {
  StopReason reason = StopReason::converged;
  int iterations = 0;
  int tangents = 0;               ///< assembled and factorised: the iterations with a tangent of their own
  std::vector<double> residuals;  ///< relative, one an iteration and the last
  int shortened = 0;              ///< line searches that took less than the whole step
  bool indefinite = false;        ///< some tangent was not positive definite
  bool unstable = false;          ///< the last one was not: the equilibrium is no minimum
  bool converged() const { return reason == StopReason::converged; }
};

/// A state of a system at rest and its residual.
struct RestState {
  Vector y;
  Residual residual;
  /// ‖R‖ on the field over Σ ‖force‖ of the terms.
  double relative = 0;
};
RestState rest_state(const System& system, double t, Vector y);

/// Newton's method for a system at rest at a time (or load parameter), keeping its factorisation for further
/// calls. Steps are shortened until det F > 0 and the potential falls, the residuals fall, or (where unknowns
/// are solved apart) the next simplified correction is smaller than the step (natural monotonicity test,
/// Deuflhard 2011, §3.3.2).
class Newton {
 public:
  /// Both must outlive it.
  Newton(const System& system, LinearSystem& linear) : system_(system), linearised_(system, linear) {}

  /// y is replaced by the solution only when it converged.
  NewtonReport solve(double t, RestState from, Vector& y, const NewtonOptions& options);

 private:
  class Run;
  const System& system_;
  Linearised linearised_;
  bool has_tangent_ = false;  // its factors may serve
};

/// The unknowns of a mixed form (mixed_form) at a time: a displacement, moved to where the constraints have
/// it, and the pressures that belong to it.
Vector mixed_start(const System& mixed, double t, const Vector& c);

/// Newton's method in the mixed form from a displacement, and the pressures that belong to it, on. `linear`
/// is of the system (System::make_linear). c, the field, is replaced by the solution only when it converged.
NewtonReport newton(const System& system, double t, LinearSystem& linear, Vector& c,
                    const NewtonOptions& options = {});

}  // namespace polyaffine
