#pragma once

#include <functional>
#include <string>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Right-hand side of ẏ = f(t, y): writes f into `rate`, which has the size of `state`. Exceptions it throws
/// leave solve_ode unchanged.
using OdeRate = std::function<void(double time, const Vector& state, Vector& rate)>;

struct OdeOptions {
  double relative_tolerance = 1e-8;
  double absolute_tolerance = 1e-10;  ///< in the unit of the states, the same for all
  double max_step = 0;                ///< in the unit of time; 0: not limited
  long max_steps = 1000000;           ///< for the whole interval
};

enum class OdeStop { finished, too_many_steps, error_test_failed, convergence_failed, other_failure };

struct OdeSolution {
  Matrix states;  ///< one column an output time; only those reached
  OdeStop stop = OdeStop::finished;
  std::string message;  ///< why it stopped before the last output time; empty when finished
  double time_reached = 0;
  long steps = 0, rate_evaluations = 0, jacobian_evaluations = 0, error_test_failures = 0;

  bool finished() const { return stop == OdeStop::finished; }
};

/// Solves the small stiff system ẏ = f(t, y), y(start_time) = initial, with variable-order BDF (CVODE; dense
/// finite-difference Jacobian, Newton) and returns y at `times`, interpolated to the order of the method.
///
/// `times` must increase and not lie before start_time (equal is allowed); tolerances must be positive and
/// the initial state finite: std::invalid_argument otherwise. That the integration stops early is told in the
/// solution, not thrown. Kinks of f are passed by error control; restart at known ones for the full order.
/// Source: Hindmarsh et al. 2005 (SUNDIALS).
OdeSolution solve_ode(const OdeRate& rate, double start_time, const Vector& initial, const Vector& times,
                      const OdeOptions& options = {});

}  // namespace polyaffine
