#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <polyaffine/linear/linear_system.hpp>
#include <polyaffine/solve/projection.hpp>
#include <polyaffine/system/field_energy.hpp>

namespace polyaffine {

/// One term s(λ)·E(c; state(λ)) of a potential, λ ∈ [0, 1] being the load parameter.
struct PotentialTerm {
  std::shared_ptr<const FieldEnergy> energy;
  std::function<double(double)> scale = [](double) { return 1.0; };
  std::function<PointState(double)> state = [](double) { return PointState(); };
  bool wall = true;  ///< its M is a deformation gradient, det M must stay positive
};

/// Stationary points of Π(c, λ) = Σ_k s_k(λ) E_k(c), with fixed unknowns c_i = λ·prescribed_i or linear
/// constraints C c = λ d by projection (not both), solved with `projected_system`.
struct EquilibriumProblem {
  std::vector<PotentialTerm> terms;
  std::vector<char> fixed;                       ///< by unknown; empty: none
  Vector prescribed;                             ///< by unknown, used where fixed; empty: zero
  std::shared_ptr<const Projection> projection;  ///< null: no linear constraints
};

/// The unknowns of the mixed form: displacement coefficients, and for each term with a pressure space its
/// pressures (kPa; κ M⁻¹ g(c) where they are empty).
struct MixedState {
  Vector c;
  std::vector<Vector> pressures;
};

struct NewtonOptions {
  double tolerance = 1e-8;  ///< on ‖residual‖ over Σ ‖force‖ of the terms, or a step of strain below 1e-11
  double dilatation_tolerance = 1e-8;  ///< on the largest |M⁻¹ R_p|
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

struct LoadOptions {
  double first_step = 0.1;
  double smallest_step = 1e-4;
  double largest_step = 1.0;
  double path_slack = 1;  ///< factor on the tolerances of Newton before λ = 1
  NewtonOptions newton;
  std::function<void(double load, const Vector& c)> on_step{};  ///< called at every equilibrium of the path
  std::function<bool()> interrupted{};  ///< asked before each step; true ends the path
};

struct LoadReport {
  StopReason reason = StopReason::converged;
  double reached = 0;                   ///< last load parameter in equilibrium
  std::optional<double> unstable_from;  ///< first equilibrium that is no minimum: it need not be the only one
  int steps = 0, cuts = 0, iterations = 0, tangents = 0;
  NewtonReport last;
  bool converged() const { return reason == StopReason::converged; }
};

/// Newton's method on the residuals (R_u, R_p) of the mixed form, the pressures' step eliminated by
/// (K + κ DᵀM⁻¹D) Δc = −R_u − κ DᵀM⁻¹R_p,  Δp = κ M⁻¹(R_p + D Δc):
/// stiff volumes cost no more iterations than soft ones. Steps are shortened until det F > 0 and the next
/// simplified Newton correction is smaller than the step (natural monotonicity test, Deuflhard 2011, §3.3.2).
/// Terms without a pressure space have only R_u. The state is replaced by the solution only when it
/// converged.
NewtonReport newton(const EquilibriumProblem& problem, double load, LinearSystem& system, MixedState& state,
                    const NewtonOptions& options = {});
/// The same from the pressures that belong to c.
NewtonReport newton(const EquilibriumProblem& problem, double load, LinearSystem& system, Vector& c,
                    const NewtonOptions& options = {});

/// Follows the equilibrium from λ = from to λ = 1 in steps that grow or shrink with the number of tangents
/// and are halved where Newton fails; each starts from the path through the last three equilibria, or from
/// the last one where that leaves clearly less force. On failure c is the last equilibrium, at λ = reached.
LoadReport load_stepping(const EquilibriumProblem& problem, LinearSystem& system, Vector& c,
                         const LoadOptions& options = {}, double from = 0);

}  // namespace polyaffine
