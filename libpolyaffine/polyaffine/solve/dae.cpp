#include "polyaffine/solve/dae.hpp"

#include <ida/ida.h>
#include <ida/ida_ls.h>

#include <cmath>

#include <polyaffine/core/error.hpp>
#include <polyaffine/core/stopwatch.hpp>
#include <polyaffine/solve/secant_updates.hpp>
#include <polyaffine/solve/sundials_support.hpp>

namespace polyaffine {
namespace {

constexpr double kChangeOfAlpha = 0.5;  // relative, that needs a new factorisation
constexpr int kMaxIterations = 6;       // of Newton's method in a step

// Steps change by these factors alone, not by what the error would just allow: rounding then moves no step
// and, with it, no number of iterations. For this the step also stays where it would grow beyond the largest,
// instead of being cut to it.
constexpr double kStepGrowth = 1.5, kStepCut = 0.5;
constexpr double kNoGrowth = 1e10;

using sundials::check;
using sundials::view;

// The system keeps its own factorisation; SUNDIALS sees a matrix and a direct solver without content.
SUNMatrix_ID matrix_id(SUNMatrix) {
  return SUNMATRIX_CUSTOM;
}
int matrix_zero(SUNMatrix) {
  return 0;
}
void matrix_destroy(SUNMatrix A) {
  SUNMatFreeEmpty(A);
}
SUNMatrix matrix_clone(SUNMatrix A);

SUNMatrix make_matrix(SUNContext context) {
  SUNMatrix A = SUNMatNewEmpty(context);
  A->content = nullptr;
  A->ops->getid = matrix_id;
  A->ops->zero = matrix_zero;
  A->ops->destroy = matrix_destroy;
  A->ops->clone = matrix_clone;
  return A;
}

SUNMatrix matrix_clone(SUNMatrix A) {
  return make_matrix(A->sunctx);
}

SUNLinearSolver_Type solver_type(SUNLinearSolver) {
  return SUNLINEARSOLVER_DIRECT;
}
// The system's factorisation, improved by what the iterations since then have shown.
struct DirectSolver {
  Linearised* linearised = nullptr;
  SecantUpdates updates;
  N_Vector weights = nullptr;
  void* ida = nullptr;
};

int solver_setup(SUNLinearSolver S, SUNMatrix) {
  static_cast<DirectSolver*>(S->content)->updates.clear();
  return 0;
}
int solver_scaling(SUNLinearSolver S, N_Vector weights, N_Vector) {
  static_cast<DirectSolver*>(S->content)->weights = weights;
  return 0;
}
int solver_solve(SUNLinearSolver S, SUNMatrix, N_Vector x, N_Vector b, realtype) {
  auto& solver = *static_cast<DirectSolver*>(S->content);
  N_Vector y = nullptr, rate = nullptr;  // the iterate that b is the residual of
  double t = 0;
  IDAGetCurrentTime(solver.ida, &t);
  IDAGetCurrentY(solver.ida, &y);
  IDAGetCurrentYp(solver.ida, &rate);
  const Vector y_now = view(y), rate_now = view(rate);
  Vector out;
  if (!solver.linearised->solve({t, y_now, &rate_now}, view(b), out)) return 1;
  solver.updates.improve(view(solver.weights), out);
  Eigen::Map<Vector>(N_VGetArrayPointer(x), out.size()) = out;
  return 0;
}
int solver_free(SUNLinearSolver S) {
  S->content = nullptr;
  SUNLinSolFreeEmpty(S);
  return 0;
}

SUNLinearSolver make_solver(DirectSolver& content, SUNContext context) {
  SUNLinearSolver S = SUNLinSolNewEmpty(context);
  S->content = &content;
  S->ops->gettype = solver_type;
  S->ops->setscalingvectors = solver_scaling;
  S->ops->setup = solver_setup;
  S->ops->solve = solver_solve;
  S->ops->free = solver_free;
  return S;
}

// What IDA hands back to the callbacks.
struct UserData {
  const System* system = nullptr;
  DirectSolver* solver = nullptr;
  double relative_tolerance = 0;
  Vector absolute_tolerance, error_weight;  // by unknown
  double t = 0;                             // of the last residual
  double min_det = 1, max_det = 1;
  SystemCost cost;
};

int residual(realtype t, N_Vector y, N_Vector rate, N_Vector out, void* user) {
  auto& data = *static_cast<UserData*>(user);
  const Stopwatch watch(data.cost.residual_s);
  ++data.cost.residuals;
  if (t != data.t) data.solver->updates.restart();
  data.t = t;
  const Vector y_now = view(y), rate_now = view(rate);
  const Residual r = data.system->residual({t, y_now, &rate_now});
  if (!r.admissible()) return 1;
  if (std::isfinite(r.min_det)) {
    data.min_det = r.min_det;
    data.max_det = r.max_det;
  }
  Eigen::Map<Vector>(N_VGetArrayPointer(out), r.values.size()) = r.values;
  return 0;
}

int jacobian(realtype t, realtype alpha, N_Vector y, N_Vector rate, N_Vector, SUNMatrix, void* user, N_Vector,
             N_Vector, N_Vector) {
  const Vector y_now = view(y), rate_now = view(rate);
  return static_cast<UserData*>(user)->solver->linearised->factorise({t, y_now, &rate_now}, alpha) ? 0 : 1;
}

int error_weights(N_Vector y, N_Vector weights, void* user) {
  const auto& data = *static_cast<UserData*>(user);
  Eigen::Map<Vector> w(N_VGetArrayPointer(weights), N_VGetLength(weights));
  w = data.error_weight.array() /
      (data.relative_tolerance * view(y).array().abs() + data.absolute_tolerance.array());
  return 0;
}

// The tolerances of a layout's unknowns and their weights in the error norm.
void set_tolerances(const StateLayout& layout, UserData& data) {
  data.absolute_tolerance.resize(layout.size());
  data.error_weight = Vector::Ones(layout.size());
  for (const Block& block : layout.blocks())
    block.at.of(data.absolute_tolerance).setConstant(block.absolute_tolerance);
  const double field = layout.field().size, few = static_cast<double>(layout.few().size());
  if (field > 0 && few > 0) data.error_weight(layout.few()).setConstant(std::sqrt(field / few));
  // The mean is over all unknowns: those that no norm sees are to leave it as it is without them, and states
  // of points count as often as the field.
  double seen = field + few;
  for (const Block& block : layout.blocks()) {
    if (block.solved != Solved::apart || !std::isfinite(block.absolute_tolerance)) continue;
    seen += field;
    block.at.of(data.error_weight).setConstant(std::sqrt(field / block.at.size));
  }
  data.error_weight *= std::sqrt(static_cast<double>(layout.size()) / seen);
}

// 1 for the unknowns that the error test sees, 0 for the others; empty where it sees all.
Vector error_tested(const StateLayout& layout) {
  Vector out = Vector::Ones(layout.size());
  for (const Block& block : layout.blocks())
    if (!block.error_tested) block.at.of(out).setZero();
  return out.minCoeff() > 0 ? Vector() : out;
}

std::string describe(int flag) {
  switch (flag) {
    case IDA_ERR_FAIL:
      return "the error test could not be met with the smallest step";
    case IDA_CONV_FAIL:
      return "Newton did not converge with the smallest step";
    case IDA_LSETUP_FAIL:
      return "the tangent is singular with the smallest step";
    case IDA_REP_RES_ERR:
      return "the body turns inside out (det F not positive) with the smallest step";
    case IDA_TOO_MUCH_ACC:
      return "the tolerance is below rounding error";
    default:
      return "IDA code " + std::to_string(flag);
  }
}

}  // namespace

struct DaeIntegrator::Implementation {
  System system;  // in the mixed form; what its terms have added to the layout stands last
  int size;       // without that
  sundials::Context context;
  sundials::NVector y, rate;
  sundials::Matrix matrix;
  Linearised linearised;
  DirectSolver direct;
  sundials::LinearSolver solver;
  UserData user;
  double t = 0, max_step = 0;
  Vector y_out, rate_out;
  std::string failure;
  void* ida = nullptr;

  Implementation(const System& of, LinearSystem& linear_system)
      : system(mixed_form(of)), size(of.size()), linearised(system, linear_system) {}
  ~Implementation() {
    if (ida) IDAFree(&ida);
  }
};

DaeIntegrator::DaeIntegrator(const System& system, const DaeOptions& options, double t, const Vector& y,
                             const Vector& rate)
    : own_linear_(system.make_linear()), impl_(std::make_unique<Implementation>(system, *own_linear_)) {
  begin(options, t, y, rate);
}

DaeIntegrator::DaeIntegrator(const System& system, LinearSystem& linear, const DaeOptions& options, double t,
                             const Vector& y, const Vector& rate)
    : impl_(std::make_unique<Implementation>(system, linear)) {
  begin(options, t, y, rate);
}

void DaeIntegrator::begin(const DaeOptions& options, double t, const Vector& y, const Vector& rate) {
  auto& m = *impl_;
  const StateLayout& layout = m.system.layout;
  m.max_step = options.max_step;
  m.user.system = &m.system;
  m.user.solver = &m.direct;
  m.user.relative_tolerance = options.relative_tolerance;
  m.user.t = t;
  set_tolerances(layout, m.user);
  m.direct.linearised = &m.linearised;
  m.t = t;
  m.y_out = y;
  m.rate_out = rate;
  Vector y_all = Vector::Zero(layout.size()), rate_all = Vector::Zero(layout.size());
  y_all.head(m.size) = y;
  rate_all.head(m.size) = rate;
  for (const auto& term : m.system.terms) term->start(y_all, &rate_all);
  m.y = sundials::make_vector(y_all, m.context);
  m.rate = sundials::make_vector(rate_all, m.context);
  m.direct.ida = m.ida = IDACreate(m.context);
  check(IDAInit(m.ida, residual, t, m.y.get(), m.rate.get()), "IDAInit");
  check(IDASetUserData(m.ida, &m.user), "IDASetUserData");
  check(IDASetErrFile(m.ida, nullptr), "IDASetErrFile");
  check(IDAWFtolerances(m.ida, error_weights), "IDAWFtolerances");
  m.matrix.reset(make_matrix(m.context));
  m.solver.reset(make_solver(m.direct, m.context));
  check(IDASetLinearSolver(m.ida, m.solver.get(), m.matrix.get()), "IDASetLinearSolver");
  check(IDASetJacFn(m.ida, jacobian), "IDASetJacFn");
  check(IDASetMaxOrd(m.ida, options.max_order), "IDASetMaxOrd");
  // Iterations learn the tangent's change with α, and that of the state, better than a factor on the step.
  check(IDASetLinearSolutionScaling(m.ida, SUNFALSE), "IDASetLinearSolutionScaling");
  check(IDASetDeltaCjLSetup(m.ida, kChangeOfAlpha), "IDASetDeltaCjLSetup");
  check(IDASetMaxNonlinIters(m.ida, kMaxIterations), "IDASetMaxNonlinIters");
  check(IDASetEtaMax(m.ida, kStepGrowth), "IDASetEtaMax");
  check(IDASetEtaMin(m.ida, kStepCut), "IDASetEtaMin");
  check(IDASetEtaLow(m.ida, kStepCut), "IDASetEtaLow");
  check(IDASetEtaMinErrFail(m.ida, kStepCut), "IDASetEtaMinErrFail");
  if (const Vector by_unknown = error_tested(layout); by_unknown.size() > 0) {
    const sundials::NVector tested = sundials::make_vector(by_unknown, m.context);
    check(IDASetId(m.ida, tested.get()), "IDASetId");  // copies
    check(IDASetSuppressAlg(m.ida, SUNTRUE), "IDASetSuppressAlg");
  }
  if (options.max_step > 0) check(IDASetMaxStep(m.ida, options.max_step), "IDASetMaxStep");
  if (options.first_step > 0) check(IDASetInitStep(m.ida, options.first_step), "IDASetInitStep");
}

DaeIntegrator::~DaeIntegrator() = default;

DaeStatus DaeIntegrator::step(double limit) {
  auto& m = *impl_;
  double h = 0;
  check(IDAGetCurrentStep(m.ida, &h), "IDAGetCurrentStep");
  const bool may_grow = m.max_step <= 0 || kStepGrowth * h < m.max_step;
  check(IDASetEtaFixedStepBounds(m.ida, 1.0, may_grow ? kStepGrowth : kNoGrowth), "IDASetEtaFixedStepBounds");
  check(IDASetStopTime(m.ida, limit), "IDASetStopTime");
  double reached = m.t;
  const int flag = IDASolve(m.ida, limit, &reached, m.y.get(), m.rate.get(), IDA_ONE_STEP);
  if (flag < 0) {
    m.failure = describe(flag);
    return DaeStatus::failed;
  }
  m.t = reached;
  m.y_out = view(m.y.get()).head(m.size);
  m.rate_out = view(m.rate.get()).head(m.size);
  return DaeStatus::reached;
}

void DaeIntegrator::interpolate(double t, Vector& y) const {
  auto& m = *impl_;
  const sundials::NVector out(N_VClone(m.y.get()));
  check(IDAGetDky(m.ida, t, 0, out.get()), "IDAGetDky");
  y = view(out.get()).head(m.size);
}

double DaeIntegrator::time() const {
  return impl_->t;
}
const Vector& DaeIntegrator::y() const {
  return impl_->y_out;
}
const Vector& DaeIntegrator::rate() const {
  return impl_->rate_out;
}
const std::string& DaeIntegrator::failure() const {
  return impl_->failure;
}

double DaeIntegrator::min_det() const {
  return impl_->user.min_det;
}
double DaeIntegrator::max_det() const {
  return impl_->user.max_det;
}

SystemCost DaeIntegrator::cost() const {
  SystemCost out = impl_->linearised.cost();
  out += impl_->user.cost;
  return out;
}

DaeCounters DaeIntegrator::counters() const {
  DaeCounters c;
  IDAGetNumSteps(impl_->ida, &c.steps);
  IDAGetNumResEvals(impl_->ida, &c.residuals);
  IDAGetNumNonlinSolvIters(impl_->ida, &c.newton_iterations);
  IDAGetNumJacEvals(impl_->ida, &c.factorisations);
  IDAGetNumErrTestFails(impl_->ida, &c.error_test_failures);
  IDAGetNumNonlinSolvConvFails(impl_->ida, &c.convergence_failures);
  return c;
}

}  // namespace polyaffine
