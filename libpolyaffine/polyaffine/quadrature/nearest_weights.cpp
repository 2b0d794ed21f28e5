#include "polyaffine/quadrature/nearest_weights.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <limits>
#include <stdexcept>
#include <utility>

namespace polyaffine {
namespace {

constexpr double kShortest = 1e-6;  // step of the line search

// Conditions Qᵀx = d on x = w/√w⁰, with orthonormal columns of Q (points × independent conditions).
struct Orthonormal {
  Matrix Q;
  Vector d;
};

Orthonormal orthonormal(const WeightConditions& conditions, const Vector& root, double dependent) {
  const Vector inverse = conditions.scale.cwiseInverse();
  const Matrix columns = root.asDiagonal() * conditions.A.transpose() * inverse.asDiagonal();
  const Vector b = inverse.asDiagonal() * conditions.b;
  Eigen::ColPivHouseholderQR<Matrix> qr(columns.rows(), columns.cols());
  qr.setThreshold(dependent);
  qr.compute(columns);
  const Eigen::Index rank = qr.rank();
  const Vector pivoted = (qr.colsPermutation().transpose() * b).head(rank);
  return {qr.householderQ() * Matrix::Identity(columns.rows(), rank),
          qr.matrixR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().transpose().solve(pivoted)};
}

// x of the multipliers and the value of the dual, which is to be maximised.
struct Dual {
  Vector x, gradient;
  double value = 0;
};

Dual evaluate(const Orthonormal& c, const Vector& root, double least, const Vector& multipliers) {
  Dual out;
  out.x = (root + c.Q * multipliers).cwiseMax(least * root);
  out.gradient = c.d - c.Q.transpose() * out.x;
  out.value = 0.5 * (out.x - root).squaredNorm() + multipliers.dot(out.gradient);
  return out;
}

// Newton step of the dual: its curvature is that of the points above their lower limit.
Vector newton_step(const Orthonormal& c, const Vector& x, const Vector& limit, const Vector& gradient) {
  constexpr double kRegular = 1e-14;
  const Vector free = (x.array() > limit.array()).cast<double>();
  Matrix H = c.Q.transpose() * free.asDiagonal() * c.Q;
  H.diagonal().array() += kRegular;
  return Eigen::LDLT<Matrix>(H).solve(gradient);
}

double largest_miss(const WeightConditions& conditions, const Vector& w) {
  return ((conditions.A * w - conditions.b).array() / conditions.scale.array()).abs().maxCoeff();
}

}  // namespace

NearestWeights nearest_weights(const WeightConditions& conditions, const Vector& w0,
                               const NearestWeightsOptions& options) {
  const Eigen::Index count = conditions.A.rows();
  if (conditions.A.cols() != w0.size() || conditions.b.size() != count || conditions.scale.size() != count)
    throw std::invalid_argument("nearest_weights: sizes of conditions and weights differ");
  if (!(w0.minCoeff() > 0))
    throw std::invalid_argument("nearest_weights: found a weight that is not positive");
  const Vector root = w0.cwiseSqrt();
  const Orthonormal c = orthonormal(conditions, root, options.dependent);
  Vector multipliers = Vector::Zero(c.d.size());
  Dual now = evaluate(c, root, options.least, multipliers);
  NearestWeights out;
  out.miss = std::numeric_limits<double>::infinity();
  for (;; ++out.iterations) {
    const Vector w = now.x.cwiseProduct(root);
    const double miss = largest_miss(conditions, w);
    if (miss < out.miss) {
      out.weights = w;
      out.miss = miss;
    }
    out.met = out.miss <= options.tolerance;
    if (out.met || out.iterations == options.max_iterations) return out;
    const Vector step = newton_step(c, now.x, options.least * root, now.gradient);
    const double slope = now.gradient.dot(step);
    Dual trial;
    for (double length = 1;; length /= 2) {
      trial = evaluate(c, root, options.least, multipliers + length * step);
      const bool better =
          trial.value >= now.value + 1e-4 * length * slope || trial.gradient.norm() < now.gradient.norm() / 2;
      if (!better && length > kShortest) continue;
      multipliers += length * step;
      break;
    }
    now = std::move(trial);
  }
}

}  // namespace polyaffine
