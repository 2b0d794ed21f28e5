#include "polyaffine/linear/two_level.hpp"

#include <Eigen/CholmodSupport>
#include <Eigen/IterativeLinearSolvers>

#include <polyaffine/core/serial_blas.hpp>

namespace polyaffine {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// The preconditioner in the form that Eigen::ConjugateGradient asks for. With A = L + D + Lᵀ, whose columns
// are its rows:
//
//     (L + D) z = r              the sweep forwards, which leaves the residual −Lᵀz;
//     z += P (PᵀAP)⁻¹ Pᵀ(−Lᵀz)   the correction in the coarse space;
//     (D + Lᵀ) z' = r − L z      the sweep backwards.
class TwoLevelPreconditioner {
 public:
  /// To be called before the solver's `compute`; keeps references. (The matrix that the solver hands on is a
  /// view that does not last.)
  void set(const Sparse& A, const Sparse& P) {
    A_ = &A;
    P_ = &P;
    diagonal_ = A.diagonal();
    coarse_.compute(Sparse(P.transpose() * A * P));
  }
  template <class View>
  TwoLevelPreconditioner& analyzePattern(const View&) {
    return *this;
  }
  template <class View>
  TwoLevelPreconditioner& factorize(const View&) {
    return *this;
  }
  template <class View>
  TwoLevelPreconditioner& compute(const View&) {
    return *this;
  }
  Eigen::ComputationInfo info() const {
    const bool definite = coarse_.info() == Eigen::Success && diagonal_.minCoeff() > 0;
    return definite ? Eigen::Success : Eigen::NumericalIssue;
  }

  Vector solve(const Vector& r) const {
    Vector z(r.size());
    Vector rest(r.size());
    for (Eigen::Index i = 0; i < r.size(); ++i) z[i] = (r[i] - lower(i, z)) / diagonal_[i];
    for (Eigen::Index i = 0; i < r.size(); ++i) rest[i] = -upper(i, z);
    z += *P_ * coarse_.solve(Vector(P_->transpose() * rest));
    for (Eigen::Index i = r.size() - 1; i >= 0; --i) z[i] = (r[i] - lower(i, z) - upper(i, z)) / diagonal_[i];
    return z;
  }

 private:
  double lower(Eigen::Index i, const Vector& z) const {
    double sum = 0;
    for (Sparse::InnerIterator it(*A_, i); it && it.row() < i; ++it) sum += it.value() * z[it.row()];
    return sum;
  }
  double upper(Eigen::Index i, const Vector& z) const {
    double sum = 0;
    const auto* row = A_->innerIndexPtr();
    const double* value = A_->valuePtr();
    for (Eigen::Index k = A_->outerIndexPtr()[i + 1] - 1; k >= A_->outerIndexPtr()[i] && row[k] > i; --k)
      sum += value[k] * z[row[k]];
    return sum;
  }

  const Sparse* A_ = nullptr;
  const Sparse* P_ = nullptr;
  Vector diagonal_;
  Eigen::CholmodSupernodalLLT<Sparse, Eigen::Lower> coarse_;
};

}  // namespace

std::optional<Vector> solve_two_level(const Sparse& A, const Sparse& P, const Vector& b, double tolerance,
                                      int most_iterations, TwoLevelReport* report) {
  const SerialBlas serial;
  Eigen::ConjugateGradient<Sparse, Eigen::Lower | Eigen::Upper, TwoLevelPreconditioner> gradients;
  gradients.preconditioner().set(A, P);
  gradients.setTolerance(tolerance).setMaxIterations(most_iterations).compute(A);
  if (gradients.info() != Eigen::Success) return std::nullopt;
  const Vector x = gradients.solve(b);
  if (report) *report = {static_cast<int>(gradients.iterations()), gradients.error()};
  if (gradients.info() != Eigen::Success) return std::nullopt;
  return x;
}

}  // namespace polyaffine
