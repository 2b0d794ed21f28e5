#include "polyaffine/linear/two_level.hpp"

#include <Eigen/CholmodSupport>

#include <polyaffine/core/serial_blas.hpp>

namespace polyaffine {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// A = L + D + Lᵀ: columns of A are its rows.
class Preconditioner {
 public:
  Preconditioner(const Sparse& A, const Sparse& P) : A_(A), P_(P), diagonal_(A.diagonal()) {
    const Sparse coarse = P.transpose() * A * P;
    coarse_.compute(coarse);
  }

  bool definite() const { return coarse_.info() == Eigen::Success && diagonal_.minCoeff() > 0; }

  Vector apply(const Vector& r) const {
    Vector z(r.size());
    Vector rest(r.size());
    for (Eigen::Index i = 0; i < r.size(); ++i) z[i] = (r[i] - lower(i, z)) / diagonal_[i];
    for (Eigen::Index i = 0; i < r.size(); ++i) rest[i] = -upper(i, z);
    z += P_ * coarse_.solve(Vector(P_.transpose() * rest));
    for (Eigen::Index i = r.size() - 1; i >= 0; --i) z[i] = (r[i] - lower(i, z) - upper(i, z)) / diagonal_[i];
    return z;
  }

 private:
  double lower(Eigen::Index i, const Vector& z) const {
    double sum = 0;
    for (Sparse::InnerIterator it(A_, i); it && it.row() < i; ++it) sum += it.value() * z[it.row()];
    return sum;
  }
  double upper(Eigen::Index i, const Vector& z) const {
    double sum = 0;
    const auto* row = A_.innerIndexPtr();
    const double* value = A_.valuePtr();
    for (Eigen::Index k = A_.outerIndexPtr()[i + 1] - 1; k >= A_.outerIndexPtr()[i] && row[k] > i; --k)
      sum += value[k] * z[row[k]];
    return sum;
  }

  const Sparse& A_;
  const Sparse& P_;
  Vector diagonal_;
  Eigen::CholmodSupernodalLLT<Sparse, Eigen::Lower> coarse_;
};

}  // namespace

std::optional<Vector> solve_two_level(const Sparse& A, const Sparse& P, const Vector& b, double tolerance,
                                      int most_iterations, TwoLevelReport* report) {
  const SerialBlas serial;
  const Preconditioner preconditioner(A, P);
  if (!preconditioner.definite()) return std::nullopt;
  Vector x = Vector::Zero(b.size());
  Vector r = b;
  Vector direction = Vector::Zero(b.size());
  double last = 1;
  const double least = tolerance * b.norm();
  int iteration = 0;
  for (; r.norm() > least && iteration < most_iterations; ++iteration) {
    const Vector z = preconditioner.apply(r);
    const double now = r.dot(z);
    direction = z + (iteration == 0 ? 0.0 : now / last) * direction;
    last = now;
    const Vector image = A * direction;
    const double length = now / direction.dot(image);
    x += length * direction;
    r -= length * image;
  }
  if (report) *report = {iteration, b.norm() > 0 ? r.norm() / b.norm() : 0};
  if (!(r.norm() <= least)) return std::nullopt;
  return x;
}

}  // namespace polyaffine
