#include "cardiac/strain/affine_parameters.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>

#include <cardiac/anatomy/segments.hpp>

namespace cardiac {

using polyaffine::FrameBasis;
using polyaffine::Mat3;
using polyaffine::Vec3;
using polyaffine::Vector;

namespace {

using Coefficients = std::array<Vec3, 4>;  // of 1, l, c, t

const std::array<polyaffine::Monomial, 4> kAffine{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

// What turns coefficients of one frame into its gradient at the node: H = Q [c_l c_c c_t] ∇ξ + ∂Q c_1.
struct NodeGeometry {
  Mat3 Q = Mat3::Identity();
  std::array<Mat3, 3> dQ{Mat3::Zero(), Mat3::Zero(), Mat3::Zero()};
  Mat3 xi_gradient = Mat3::Identity();
  Vec3 xi = Vec3::Zero();
};

NodeGeometry geometry(const FrameBasis& basis, const ControlNode& node, int frame) {
  const auto at = basis.field().sample(node.tet, node.barycentric);
  NodeGeometry out;
  const auto own =
      std::find_if(at.frames.begin(), at.frames.end(), [&](const auto& f) { return f.frame == frame; });
  out.xi_gradient = own->xi_gradient;
  out.xi = own->xi;
  if (basis.in_local_axes(basis.function(frame, kAffine[0]))) {
    out.Q = at.Q;
    out.dQ = at.dQ;
  }
  return out;
}

Mat3 transported(const NodeGeometry& g, const Vec3& value) {
  Mat3 out;
  for (int J = 0; J < 3; ++J) out.col(J) = g.dQ[J] * value;
  return out;
}

// The mean of c_c over each ring of more than one node is removed.
void centre(std::vector<Coefficients>& all) {
  for (int ring = 1; ring <= 3; ++ring) {
    const int first = aha_ring_first(ring) - 1;
    const int n = aha_ring_size(ring);
    Vec3 mean = Vec3::Zero();
    for (int k = first; k < first + n; ++k) mean += all[k][2] / n;
    for (int k = first; k < first + n; ++k) all[k][2] -= mean;
  }
}

bool reduced_ring(const FrameBasis& basis, int ring) {
  const int last = aha_ring_first(ring) + aha_ring_size(ring) - 2;
  return basis.function(last, kAffine[2]) < 0;
}

}  // namespace

std::vector<SegmentFrame> affine_parameters(const FrameBasis& basis, const std::vector<ControlNode>& nodes,
                                            const Vector& c) {
  std::vector<Coefficients> all(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int m = 0; m < 4; ++m) {
      const int f = basis.function(static_cast<int>(i), kAffine[m]);
      all[i][m] = f < 0 ? Vec3::Zero() : Vec3(c.segment<3>(3 * f));
    }
  if (reduced_ring(basis, 1)) centre(all);
  std::vector<SegmentFrame> out;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const NodeGeometry g = geometry(basis, nodes[i], static_cast<int>(i));
    Mat3 slopes;
    slopes << all[i][1], all[i][2], all[i][3];
    const Vec3 value = all[i][0] + slopes * g.xi;
    const Mat3 H = g.Q * slopes * g.xi_gradient + transported(g, value);
    const Mat3& R = nodes[i].axes;
    out.push_back({Mat3::Identity() + R.transpose() * H * R, R.transpose() * g.Q * value});
  }
  return out;
}

Vector affine_coefficients(const FrameBasis& basis, const std::vector<ControlNode>& nodes,
                           const std::vector<SegmentFrame>& frames, const Vector& rest) {
  std::vector<Coefficients> all(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const NodeGeometry g = geometry(basis, nodes[i], static_cast<int>(i));
    const Mat3& R = nodes[i].axes;
    const Vec3 value = g.Q.inverse() * R * frames[i].t;
    const Mat3 H = R * (frames[i].A - Mat3::Identity()) * R.transpose() - transported(g, value);
    const Mat3 slopes = g.Q.inverse() * H * g.xi_gradient.inverse();
    all[i] = {Vec3(value - slopes * g.xi), slopes.col(0), slopes.col(1), slopes.col(2)};
  }
  for (int ring = 1; ring <= 3; ++ring) {  // back to the independent functions
    if (!reduced_ring(basis, ring)) continue;
    const int first = aha_ring_first(ring) - 1;
    const int last = first + aha_ring_size(ring) - 1;
    const Vec3 shift = all[last][2];
    for (int k = first; k <= last; ++k) all[k][2] -= shift;
  }
  Vector c = rest;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int m = 0; m < 4; ++m)
      if (const int f = basis.function(static_cast<int>(i), kAffine[m]); f >= 0)
        c.segment<3>(3 * f) = all[i][m];
  return c;
}

std::vector<SegmentFrame> fit_affine(const std::vector<ControlNode>& nodes, const std::vector<int>& segment,
                                     const polyaffine::Points& X, const polyaffine::Points& x,
                                     const Vector& weights) {
  using Mat4 = Eigen::Matrix4d;
  std::vector<Mat4> normal(nodes.size(), Mat4::Zero());
  std::vector<Eigen::Matrix<double, 3, 4>> moment(nodes.size(), Eigen::Matrix<double, 3, 4>::Zero());
  for (Eigen::Index q = 0; q < X.cols(); ++q) {
    const auto i = static_cast<std::size_t>(segment[q] - 1);
    const ControlNode& node = nodes[i];
    const Eigen::Vector4d p = Vec3(node.axes.transpose() * (X.col(q) - node.position)).homogeneous();
    normal[i] += weights[q] * p * p.transpose();
    moment[i] += weights[q] * (node.axes.transpose() * (x.col(q) - node.position)) * p.transpose();
  }
  std::vector<SegmentFrame> out;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Eigen::Matrix<double, 3, 4> map = moment[i] * normal[i].inverse();
    out.push_back({map.leftCols<3>(), map.col(3)});
  }
  return out;
}

}  // namespace cardiac
