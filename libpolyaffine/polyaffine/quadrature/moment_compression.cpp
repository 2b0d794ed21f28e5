#include "polyaffine/quadrature/moment_compression.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <sstream>
#include <stdexcept>

#include <polyaffine/core/error.hpp>
#include <polyaffine/quadrature/nnls.hpp>

namespace polyaffine {
namespace {

std::vector<int> positive_candidates(const Matrix& features, const Vector& weights) {
  if (features.cols() != weights.size())
    throw std::invalid_argument("compress_moments: found " + std::to_string(weights.size()) +
                                " weights, expected one for each of " + std::to_string(features.cols()) +
                                " points");
  std::vector<int> used;
  for (Eigen::Index j = 0; j < weights.size(); ++j) {
    if (!(weights[j] >= 0)) throw std::invalid_argument("compress_moments: found a negative weight");
    if (weights[j] > 0) used.push_back(static_cast<int>(j));
  }
  return used;
}

// Rows: a basis of the span of the features, orthonormal under the weights.
Matrix orthonormal_features(const Matrix& features, const Vector& weights) {
  constexpr double kDependent = 1e-12;
  const Vector root = weights.cwiseSqrt();
  Matrix g = root.asDiagonal() * features.transpose();
  for (Eigen::Index i = 0; i < g.cols(); ++i) {
    const double length = g.col(i).norm();
    if (length > 0) g.col(i) /= length;
  }
  Eigen::ColPivHouseholderQR<Matrix> qr(g.rows(), g.cols());
  qr.setThreshold(kDependent);
  qr.compute(g);
  const Matrix q = qr.householderQ() * Matrix::Identity(g.rows(), qr.rank());
  return q.transpose() * root.cwiseInverse().asDiagonal();
}

}  // namespace

CompressedRule compress_moments(const Matrix& features, const Vector& weights, double tolerance) {
  const std::vector<int> used = positive_candidates(features, weights);
  CompressedRule rule;
  if (used.empty()) return rule;
  const Vector w = weights(used);
  const Matrix basis = orthonormal_features(features(Eigen::all, used), w);
  const Vector x = nnls(basis, basis * w).x;
  for (Eigen::Index j = 0; j < x.size(); ++j)
    if (x[j] > 0) rule.points.push_back(used[j]);
  rule.weights.resize(static_cast<Eigen::Index>(rule.points.size()));
  for (Eigen::Index i = 0, j = 0; j < x.size(); ++j)
    if (x[j] > 0) rule.weights[i++] = x[j];

  const Vector scale = features.cwiseAbs() * weights;
  const Vector missed = (features(Eigen::all, rule.points) * rule.weights - features * weights).cwiseAbs();
  for (Eigen::Index i = 0; i < scale.size(); ++i)
    if (scale[i] > 0) rule.residual = std::max(rule.residual, missed[i] / scale[i]);
  if (!(rule.residual <= tolerance)) {
    std::ostringstream out;
    out << "compression of " << used.size() << " integration points to " << rule.points.size()
        << " misses a moment by a fraction " << rule.residual << ", expected at most " << tolerance;
    throw ComputationError(out.str());
  }
  return rule;
}

}  // namespace polyaffine
