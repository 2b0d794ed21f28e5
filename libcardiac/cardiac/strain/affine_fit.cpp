#include "cardiac/strain/affine_fit.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vector;

namespace {

// Below this root mean square motion (mm), rounding is all there is.
constexpr double kStill = 1e-9;

// ∫ |f|² over tets of a field that is linear in each: V/20 (|Σ f_i|² + Σ |f_i|²).
double integral_of_square(const Eigen::Matrix4Xi& tets, const Vector& volumes, const Points& f) {
  double sum = 0;
  for (Eigen::Index t = 0; t < tets.cols(); ++t) {
    Vec3 total = Vec3::Zero();
    double squares = 0;
    for (int k = 0; k < 4; ++k) {
      const auto at = f.col(tets(k, t));
      total += at;
      squares += at.squaredNorm();
    }
    sum += volumes[t] / 20 * (total.squaredNorm() + squares);
  }
  return sum;
}

}  // namespace

AffineFit::AffineFit(const polyaffine::TetMesh& mesh, const std::vector<int>& segment,
                     const std::vector<ControlNode>& nodes, const Points& x_ed)
    : x_ed_(x_ed), q_(3, nodes.size()), segments_(nodes.size()) {
  std::vector<std::vector<int>> tets(nodes.size());
  for (int t = 0; t < mesh.num_tets(); ++t) tets[segment[t] - 1].push_back(t);
  std::vector<int> local(mesh.num_points(), -1);
  for (std::size_t s = 0; s < nodes.size(); ++s) {
    const ControlNode& node = nodes[s];
    const auto column = static_cast<Eigen::Index>(s);
    q_.col(column) = x_ed(Eigen::all, mesh.tets().col(node.tet)) * node.barycentric;
    Segment& own = segments_[s];
    own.axes = node.axes;
    const auto count = static_cast<Eigen::Index>(tets[s].size());
    own.tets.resize(4, count);
    own.volumes.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      own.volumes[i] = mesh.tet_volume(tets[s][i]);
      for (int k = 0; k < 4; ++k) {
        int& place = local[mesh.tets()(k, tets[s][i])];
        if (place < 0) {
          place = static_cast<int>(own.vertices.size());
          own.vertices.push_back(mesh.tets()(k, tets[s][i]));
        }
        own.tets(k, i) = place;
      }
    }
    for (const int v : own.vertices) local[v] = -1;
    own.p.resize(4, static_cast<Eigen::Index>(own.vertices.size()));
    own.p.topRows<3>() =
        node.axes.transpose() * (x_ed(Eigen::all, own.vertices).colwise() - Vec3(q_.col(column)));
    own.p.row(3).setOnes();
    // Weights of the vertices in ∫ f pᵀ dV, and the Gram matrix ∫ p pᵀ dV.
    Eigen::Matrix4Xd weight = Eigen::Matrix4Xd::Zero(4, own.p.cols());
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Vector4d sum = own.p(Eigen::all, own.tets.col(i)).rowwise().sum();
      for (int k = 0; k < 4; ++k)
        weight.col(own.tets(k, i)) += own.volumes[i] / 20 * (sum + own.p.col(own.tets(k, i)));
    }
    const Eigen::Matrix4d gram = own.p * weight.transpose();
    own.dual = gram.ldlt().solve(weight);
  }
}

SegmentFrame AffineFit::fit(const Segment& segment, const Points& u) {
  const Points own = segment.axes.transpose() * u(Eigen::all, segment.vertices);
  const Eigen::Matrix<double, 3, 4> map = own * segment.dual.transpose();
  const double motion = integral_of_square(segment.tets, segment.volumes, own);
  const double rest = integral_of_square(segment.tets, segment.volumes, own - map * segment.p);
  const bool still = motion <= kStill * kStill * segment.volumes.sum();
  return {Mat3::Identity() + map.leftCols<3>(), map.col(3),
          still ? std::numeric_limits<double>::quiet_NaN() : std::sqrt(rest / motion)};
}

std::vector<SegmentFrame> AffineFit::frames(const Points& x) const {
  const Points u = x - x_ed_;
  std::vector<SegmentFrame> out;
  for (const Segment& segment : segments_) out.push_back(fit(segment, u));
  return out;
}

}  // namespace cardiac
