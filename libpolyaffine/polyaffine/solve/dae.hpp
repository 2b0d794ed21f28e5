#pragma once

#include <memory>
#include <string>

#include <polyaffine/system/linearised.hpp>

namespace polyaffine {

/// Tolerances of the unknowns are those of the system's layout.
struct DaeOptions {
  double relative_tolerance = 1e-4;
  double max_step = 0;    ///< ms; 0: none
  double first_step = 0;  ///< ms; 0: chosen
  int max_order = 5;
};

struct DaeCounters {
  long steps = 0, residuals = 0, newton_iterations = 0, factorisations = 0, error_test_failures = 0,
       convergence_failures = 0;
};

enum class DaeStatus { reached, failed };

/// A system R(t, y, ẏ) = 0 in time by variable-order, variable-step BDF (SUNDIALS IDA; Hindmarsh et al.
/// 2005). A step is taken back and made smaller where the state is not admissible (det F ≤ 0). The error norm
/// is a mean over all unknowns in which the few unknowns, and each block of states that a term solves apart,
/// count as much as the whole field, however many coefficients it has. Inside, pressures of terms are
/// unknowns of their own (mixed_form), which neither the norm nor the caller sees: a tangent then serves as
/// long for a stiff volume as for a soft one.
class DaeIntegrator {
 public:
  /// The system must outlive it, and so must the LinearSystem of its field (System::make_linear), which may
  /// serve one integrator after the other.
  DaeIntegrator(const System& system, LinearSystem& linear, const DaeOptions& options, double t,
                const Vector& y, const Vector& rate);
  /// With a linear system of its own.
  DaeIntegrator(const System& system, const DaeOptions& options, double t, const Vector& y,
                const Vector& rate);
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
  SystemCost cost() const;
  /// Range of det F in the state evaluated last; after a step that is the accepted one, but for the last
  /// correction of Newton's method.
  double min_det() const;
  double max_det() const;
  const std::string& failure() const;  ///< in words, after DaeStatus::failed

 private:
  struct Implementation;
  void begin(const DaeOptions& options, double t, const Vector& y, const Vector& rate);

  std::unique_ptr<LinearSystem> own_linear_;
  std::unique_ptr<Implementation> impl_;
};

}  // namespace polyaffine
