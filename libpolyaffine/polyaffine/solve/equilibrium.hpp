#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <polyaffine/constraint/projection.hpp>
#include <polyaffine/energy/field_energy.hpp>
#include <polyaffine/solve/linear_system.hpp>

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

struct NewtonOptions {
  double tolerance = 1e-8;  ///< on ‖residual‖ over the sum of the norms of the terms' forces
  int max_iterations = 25;
  int max_halvings = 12;
};

enum class StopReason { converged, max_iterations, line_search_failed, singular_tangent, step_too_small };
std::string to_string(StopReason reason);

struct NewtonReport {
  StopReason reason = StopReason::converged;
  int iterations = 0;
  std::vector<double> residuals;  ///< relative, one an iteration and the last
  int shortened = 0;              ///< line searches that took less than the whole step
  bool indefinite = false;        ///< some tangent was not positive definite
  bool converged() const { return reason == StopReason::converged; }
};

struct LoadOptions {
  double first_step = 0.1;
  double smallest_step = 1e-4;
  double largest_step = 1.0;
  NewtonOptions newton;
  std::function<void(double load, const Vector& c)> on_step{};  ///< called at every equilibrium of the path
};

struct LoadReport {
  StopReason reason = StopReason::converged;
  double reached = 0;  ///< last load parameter in equilibrium
  int steps = 0, cuts = 0, iterations = 0;
  NewtonReport last;
  bool converged() const { return reason == StopReason::converged; }
};

/// Newton's method with a line search that keeps det F > 0 and lowers the potential (Armijo) or the residual.
/// Starts from c, which it replaces by the solution only when it converged.
NewtonReport newton(const EquilibriumProblem& problem, double load, LinearSystem& system, Vector& c,
                    const NewtonOptions& options = {});

/// Follows the equilibrium from λ = from to λ = 1 in steps that grow where Newton is quick and are halved
/// where it fails; each starts from the extrapolated path. On failure c is the last equilibrium, at λ =
/// reached.
LoadReport load_stepping(const EquilibriumProblem& problem, LinearSystem& system, Vector& c,
                         const LoadOptions& options = {}, double from = 0);

}  // namespace polyaffine
