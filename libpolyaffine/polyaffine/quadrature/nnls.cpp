#include "polyaffine/quadrature/nnls.hpp"

#include <Eigen/Jacobi>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace polyaffine {
namespace {

// Thin QR of the active columns; z = Qᵀb.
class ActiveColumns {
 public:
  ActiveColumns(const Matrix& a, const Vector& b)
      : a_(a), b_(b), q_(a.rows(), std::min(a.rows(), a.cols())), r_(q_.cols(), q_.cols()), z_(q_.cols()) {
    r_.setZero();
  }

  int size() const { return static_cast<int>(columns_.size()); }
  bool full() const { return size() == q_.cols(); }
  const std::vector<int>& columns() const { return columns_; }

  // Appends column j; false (and no change) when it depends on the active ones.
  bool append(int j) {
    constexpr double kDependent = 1e-11;
    const int k = size();
    const auto q = q_.leftCols(k);
    Vector v = a_.col(j);
    Vector h = q.transpose() * v;
    v.noalias() -= q * h;
    const Vector correction = q.transpose() * v;  // twice is enough (Parlett 1980)
    v.noalias() -= q * correction;
    h += correction;
    const double length = v.norm();
    if (length <= kDependent) return false;
    q_.col(k) = v / length;
    r_.col(k).head(k) = h;
    r_(k, k) = length;
    z_[k] = q_.col(k).dot(b_);
    columns_.push_back(j);
    return true;
  }

  void remove(int position) {
    const int k = size();
    for (int i = position; i + 1 < k; ++i) r_.col(i).head(i + 2) = r_.col(i + 1).head(i + 2);
    for (int i = position; i + 1 < k; ++i) {
      Eigen::JacobiRotation<double> g;
      g.makeGivens(r_(i, i), r_(i + 1, i));
      r_.middleCols(i, k - 1 - i).applyOnTheLeft(i, i + 1, g.adjoint());
      r_(i + 1, i) = 0;
      q_.applyOnTheRight(i, i + 1, g);
      z_.applyOnTheLeft(i, i + 1, g.adjoint());
    }
    r_.col(k - 1).setZero();
    columns_.erase(columns_.begin() + position);
  }

  Vector solve() const {
    const int k = size();
    return r_.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(z_.head(k));
  }

 private:
  const Matrix& a_;
  const Vector& b_;
  Matrix q_, r_;
  Vector z_;
  std::vector<int> columns_;
};

struct Problem {
  Matrix a;  // columns of length one (or zero)
  Vector b;
  Vector length;
};

Problem scaled(const Matrix& a, const Vector& b) {
  if (a.rows() != b.size())
    throw std::invalid_argument("nnls: found " + std::to_string(b.size()) + " right-hand sides, expected " +
                                std::to_string(a.rows()));
  if (!a.allFinite() || !b.allFinite())
    throw std::invalid_argument("nnls: found a number that is not finite");
  Problem problem{a, b, a.colwise().norm().transpose()};
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    if (problem.length[j] > 0) problem.a.col(j) /= problem.length[j];
  return problem;
}

// Moves x of the active columns towards the unconstrained minimum, dropping those that reach zero on the way.
// Returns the number of columns dropped.
int descend(ActiveColumns& active, Vector& x) {
  int dropped = 0;
  while (active.size() > 0) {
    const Vector s = active.solve();
    double step = 1;
    int blocking = -1;
    for (int i = 0; i < active.size(); ++i) {
      if (s[i] > 0) continue;
      const double from = x[active.columns()[i]];
      const double limit = from / (from - s[i]);
      if (blocking < 0 || !(limit >= step)) {
        step = from > 0 ? limit : 0;
        blocking = i;
      }
    }
    for (int i = 0; i < active.size(); ++i) {
      double& value = x[active.columns()[i]];
      value = blocking < 0 ? s[i] : std::max(0.0, value + step * (s[i] - value));
    }
    if (blocking < 0) return dropped;
    x[active.columns()[blocking]] = 0;
    active.remove(blocking);
    ++dropped;
  }
  return dropped;
}

}  // namespace

NnlsResult nnls(const Matrix& a, const Vector& b, const NnlsOptions& options) {
  const Problem problem = scaled(a, b);
  const int limit =
      options.max_iterations > 0 ? options.max_iterations : static_cast<int>(10 * (a.rows() + 1) + a.cols());
  const double tolerance = options.tolerance * b.norm();
  ActiveColumns active(problem.a, problem.b);
  NnlsResult result;
  Vector x = Vector::Zero(a.cols());
  Vector residual = b;
  while (result.iterations < limit) {
    if (residual.norm() <= std::max(tolerance, options.accuracy * b.norm())) result.converged = true;
    if (result.converged) break;
    Vector gradient = problem.a.transpose() * residual;
    for (const int j : active.columns()) gradient[j] = 0;
    // A column whose entry would not decrease the residual (rounding, dependence) is passed over.
    while (true) {
      Eigen::Index best = 0;
      if (active.full() || gradient.size() == 0 || gradient.maxCoeff(&best) <= tolerance) {
        result.converged = true;
        break;
      }
      if (active.append(static_cast<int>(best))) {
        if (active.solve()[active.size() - 1] > 0) break;
        active.remove(active.size() - 1);
      }
      gradient[best] = 0;
    }
    if (result.converged) break;
    result.iterations += 1 + descend(active, x);
    residual = b;
    for (const int j : active.columns()) residual.noalias() -= x[j] * problem.a.col(j);
  }
  result.residual = residual.norm();
  result.x = Vector::Zero(a.cols());
  for (const int j : active.columns()) result.x[j] = x[j] / problem.length[j];
  return result;
}

}  // namespace polyaffine
