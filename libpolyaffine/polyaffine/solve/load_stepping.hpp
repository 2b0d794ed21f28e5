#pragma once

#include <optional>

#include <polyaffine/solve/newton.hpp>

namespace polyaffine {

struct LoadOptions {
  double first_step = 0.1;
  double smallest_step = 1e-4;
  double largest_step = 1.0;
  double path_slack = 1;  ///< factor on the tolerances of Newton before the load parameter is 1
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

/// Follows the equilibrium of a system whose time is a load parameter, in the mixed form, from t = `from` to
/// t = 1 in steps that grow or shrink with the number of tangents and are halved where Newton fails; each
/// starts from the path through the last three equilibria, or from the last one where that leaves clearly
/// less force. `linear` is of the system (System::make_linear). On failure the displacement c is the last
/// equilibrium, at t = reached.
LoadReport load_stepping(const System& system, LinearSystem& linear, Vector& c,
                         const LoadOptions& options = {}, double from = 0);

}  // namespace polyaffine
