#include "polyaffine/solve/ode.hpp"

#include <cvode/cvode.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>

#include <polyaffine/solve/sundials_support.hpp>

namespace polyaffine {
namespace {

struct FreeCvode {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

// What CVODE hands back to evaluate_rate.
struct Callback {
  const OdeRate* rate;
  Vector state, derivative;
  std::exception_ptr thrown;
};

constexpr int kUnrecoverable = -1, kRecoverable = 1;

int evaluate_rate(double time, N_Vector state, N_Vector derivative, void* user) {
  auto& callback = *static_cast<Callback*>(user);
  callback.state = sundials::view(state);
  try {
    (*callback.rate)(time, callback.state, callback.derivative);
  } catch (...) {
    callback.thrown = std::current_exception();
    return kUnrecoverable;
  }
  if (!callback.derivative.allFinite()) return kRecoverable;
  sundials::values(derivative) = callback.derivative;
  return 0;
}

OdeStop stop_reason(int flag) {
  switch (flag) {
    case CV_TOO_MUCH_WORK:
      return OdeStop::too_many_steps;
    case CV_ERR_FAILURE:
      return OdeStop::error_test_failed;
    case CV_CONV_FAILURE:
      return OdeStop::convergence_failed;
    default:
      return OdeStop::other_failure;
  }
}

std::string describe(int flag, double time) {
  char* const name = CVodeGetReturnFlagName(flag);
  std::string text = "CVODE stopped at time " + std::to_string(time) + ": " + name;
  std::free(name);
  return text;
}

void require(bool condition, const char* expected) {
  if (!condition) throw std::invalid_argument(std::string("solve_ode: expected ") + expected);
}

void check_arguments(double start_time, const Vector& initial, const Vector& times,
                     const OdeOptions& options) {
  require(initial.size() > 0 && initial.allFinite(), "a finite, non-empty initial state");
  require(times.size() > 0 && times.allFinite() && times[0] >= start_time, "output times from the start on");
  for (Eigen::Index i = 1; i < times.size(); ++i) require(times[i] > times[i - 1], "increasing output times");
  require(options.relative_tolerance > 0 && options.absolute_tolerance > 0, "positive tolerances");
  require(options.max_step >= 0 && options.max_steps > 0, "a positive step limit");
}

}  // namespace

OdeSolution solve_ode(const OdeRate& rate, double start_time, const Vector& initial, const Vector& times,
                      const OdeOptions& options) {
  check_arguments(start_time, initial, times, options);
  const auto size = initial.size();
  const sundials::Context context;
  const sundials::NVector state = sundials::make_vector(initial, context);
  Callback callback{&rate, initial, Vector::Zero(size), nullptr};
  const std::unique_ptr<void, FreeCvode> memory(CVodeCreate(CV_BDF, context));
  void* const cvode = memory.get();
  const sundials::Matrix matrix(SUNDenseMatrix(size, size, context));
  const sundials::LinearSolver solver(SUNLinSol_Dense(state.get(), matrix.get(), context));
  using sundials::check;
  check(CVodeInit(cvode, evaluate_rate, start_time, state.get()), "CVodeInit");
  check(CVodeSStolerances(cvode, options.relative_tolerance, options.absolute_tolerance),
        "CVodeSStolerances");
  check(CVodeSetUserData(cvode, &callback), "CVodeSetUserData");
  check(CVodeSetErrHandlerFn(cvode, sundials::silence, nullptr), "CVodeSetErrHandlerFn");
  check(CVodeSetMaxStep(cvode, options.max_step), "CVodeSetMaxStep");
  check(CVodeSetStopTime(cvode, times[times.size() - 1]), "CVodeSetStopTime");
  check(CVodeSetLinearSolver(cvode, solver.get(), matrix.get()), "CVodeSetLinearSolver");

  OdeSolution solution;
  solution.states.resize(size, times.size());
  solution.time_reached = start_time;
  Eigen::Index reached = 0;
  for (; reached < times.size(); ++reached) {
    if (times[reached] > start_time) {
      CVodeGetNumSteps(cvode, &solution.steps);
      if (solution.steps >= options.max_steps) {
        solution.stop = OdeStop::too_many_steps;
        solution.message = describe(CV_TOO_MUCH_WORK, solution.time_reached);
        break;
      }
      CVodeSetMaxNumSteps(cvode, options.max_steps - solution.steps);
      const int flag = CVode(cvode, times[reached], state.get(), &solution.time_reached, CV_NORMAL);
      if (callback.thrown) std::rethrow_exception(callback.thrown);
      if (flag < 0) {
        solution.stop = stop_reason(flag);
        solution.message = describe(flag, solution.time_reached);
        break;
      }
    }
    solution.states.col(reached) = sundials::view(state.get());
  }
  solution.states.conservativeResize(size, reached);
  long solver_evaluations = 0;
  CVodeGetNumSteps(cvode, &solution.steps);
  CVodeGetNumRhsEvals(cvode, &solution.rate_evaluations);
  CVodeGetNumLinRhsEvals(cvode, &solver_evaluations);
  solution.rate_evaluations += solver_evaluations;
  CVodeGetNumJacEvals(cvode, &solution.jacobian_evaluations);
  CVodeGetNumErrTestFails(cvode, &solution.error_test_failures);
  return solution;
}

}  // namespace polyaffine
