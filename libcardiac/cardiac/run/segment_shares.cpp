#include "cardiac/run/segment_shares.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <cardiac/reduction/reduced_points.hpp>
#include <cardiac/strain/segment_strain.hpp>
#include <polyaffine/core/parallel.hpp>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

constexpr int kRounds = 100;  // of the presets leave 1e-3 of a segment's volume
constexpr double kTouching_mm2 = 1e-6;
constexpr int kNeighbours = 8;  // points among which a strain point is shared out

// The volume (mm³) of each segment (row) that lies about each point (column): strain points are shared out
// among their nearest points by the inverse fourth power of the distance.
Matrix volumes_about(const SegmentGauge& fine, const polyaffine::Points& points, Eigen::Index segments) {
  const auto count = std::min<Eigen::Index>(kNeighbours, points.cols());
  const auto strain_points = static_cast<int>(fine.segment().size());
  Eigen::MatrixXi nearest(count, strain_points);
  Matrix part(count, strain_points);
  polyaffine::parallel_for(0, strain_points, [&](int k) {
    const polyaffine::Vec3 X = fine.positions().col(k);
    const Vector square = (points.colwise() - X).colwise().squaredNorm();
    std::vector<int> order(static_cast<std::size_t>(square.size()));
    std::iota(order.begin(), order.end(), 0);
    std::partial_sort(order.begin(), order.begin() + count, order.end(),
                      [&](int a, int b) { return square[a] < square[b]; });
    for (Eigen::Index i = 0; i < count; ++i) {
      nearest(i, k) = order[static_cast<std::size_t>(i)];
      part(i, k) = std::pow(std::max(square[nearest(i, k)], kTouching_mm2), -2);
    }
    part.col(k) *= fine.weights()[k] / part.col(k).sum();
  });
  Matrix out = Matrix::Zero(segments, points.cols());
  for (int k = 0; k < strain_points; ++k)
    for (Eigen::Index i = 0; i < count; ++i)
      out(fine.segment()[static_cast<std::size_t>(k)] - 1, nearest(i, k)) += part(i, k);
  return out;
}

}  // namespace

Matrix segment_shares(const Anatomy& anatomy, const Discretisation& discretisation) {
  const VentricularCoordinates& heart = *anatomy.coordinates;
  const Vector& weights = discretisation.points.weights;
  const SegmentGauge own(heart, discretisation.points);
  const Eigen::Index segments = num_segments(heart);
  Matrix out = Matrix::Zero(segments, weights.size());
  const auto fill_up = [&] {
    for (Eigen::Index q = 0; q < out.cols(); ++q)
      if (!(out.col(q).sum() > 0)) out(own.segment()[static_cast<std::size_t>(q)] - 1, q) = weights[q];
  };
  if (!discretisation.frames && !discretisation.element_pressures) {
    fill_up();
    return out;
  }
  out = volumes_about(SegmentGauge(heart, strain_points(anatomy, discretisation)), own.positions(), segments);
  const Vector volumes = out.rowwise().sum() * (weights.sum() / out.sum());
  fill_up();
  for (int round = 0; round < kRounds; ++round) {
    for (Eigen::Index s = 0; s < segments; ++s)
      if (const double sum = out.row(s).sum(); sum > 0) out.row(s) *= volumes[s] / sum;
    for (Eigen::Index q = 0; q < out.cols(); ++q)
      if (const double sum = out.col(q).sum(); sum > 0) out.col(q) *= weights[q] / sum;
  }
  return out;
}

}  // namespace cardiac
