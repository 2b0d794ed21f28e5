#pragma once

#include <memory>
#include <string>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// An implicit system R(t, y, ẏ) = 0 together with the linear solver that fits its structure.
class DaeSystem {
 public:
  virtual ~DaeSystem() = default;
  virtual int size() const = 0;
  /// False where the state is not admissible (det F ≤ 0): the integrator then takes a smaller step.
  virtual bool residual(double t, const Vector& y, const Vector& rate, Vector& out) = 0;
  /// Factorises ∂R/∂y + α ∂R/∂ẏ; false when it is singular.
  virtual bool factorise(double t, const Vector& y, const Vector& rate, double alpha) = 0;
  /// Solves with the last factorisation.
  virtual bool solve(const Vector& rhs, Vector& x) = 0;
};

struct DaeOptions {
  double relative_tolerance = 1e-4;
  Vector absolute_tolerance;  ///< one per unknown, in its unit
  Vector error_weight;        ///< factor on each unknown's weight in the error norm; empty: 1
  /// 1, or 0 for an unknown that the error test leaves out; empty: 1. For the multipliers of constraints (of
  /// index 2): their error is that of the others over the step, so that smaller steps do not lessen it
  /// (Brenan, Campbell and Petzold 1996, §5.2).
  Vector error_tested;
  double max_step = 0;    ///< ms; 0: none
  double first_step = 0;  ///< ms; 0: chosen
  int max_order = 5;
};

struct DaeCounters {
  long steps = 0, residuals = 0, newton_iterations = 0, factorisations = 0, error_test_failures = 0,
       convergence_failures = 0;
};

enum class DaeStatus { reached, failed };

/// Variable-order, variable-step BDF (SUNDIALS IDA; Hindmarsh et al. 2005).
class DaeIntegrator {
 public:
  DaeIntegrator(DaeSystem& system, const DaeOptions& options, double t, const Vector& y, const Vector& rate);
  ~DaeIntegrator();
  DaeIntegrator(const DaeIntegrator&) = delete;
  DaeIntegrator& operator=(const DaeIntegrator&) = delete;

  /// Integrates one internal step, not past `limit`. On failure the state stays that of the last good step.
  DaeStatus step(double limit);
  /// The solution at a time inside the last step.
  void interpolate(double t, Vector& y) const;

  double time() const;
  const Vector& y() const;
  const Vector& rate() const;
  DaeCounters counters() const;
  const std::string& failure() const;  ///< in words, after DaeStatus::failed

 private:
  struct Implementation;
  std::unique_ptr<Implementation> impl_;
};

}  // namespace polyaffine
