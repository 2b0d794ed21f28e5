#include "polyaffine/kinematics/lagrange.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <map>

#include <polyaffine/core/error.hpp>
#include <polyaffine/quadrature/gauss.hpp>

namespace polyaffine {
namespace {

constexpr std::array<std::array<int, 2>, 6> kEdges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

int local_vertex(const TetMesh& mesh, int tet, int vertex) {
  for (int k = 0; k < 4; ++k)
    if (mesh.tets()(k, tet) == vertex) return k;
  return -1;
}

}  // namespace

LagrangeBasis::LagrangeBasis(const TetMesh& mesh, int order, const EdgeMidpoints& midpoints)
    : order_(order), nodes_(mesh.points()), elements_(mesh.tets()) {
  if (order != 1 && order != 2)
    throw InputError("element order: found " + std::to_string(order) + ", expected 1 or 2");
  if (order == 1) return;

  std::map<std::pair<int, int>, int> edges;
  elements_.conservativeResize(10, Eigen::NoChange);
  for (int t = 0; t < mesh.num_tets(); ++t)
    for (int e = 0; e < 6; ++e) {
      const auto key = std::minmax(mesh.tets()(kEdges[e][0], t), mesh.tets()(kEdges[e][1], t));
      elements_(4 + e, t) =
          edges.try_emplace(key, mesh.num_points() + static_cast<int>(edges.size())).first->second;
    }
  nodes_.conservativeResize(Eigen::NoChange, mesh.num_points() + static_cast<Eigen::Index>(edges.size()));
  for (const auto& [ends, node] : edges)
    nodes_.col(node) = 0.5 * (mesh.points().col(ends.first) + mesh.points().col(ends.second));
  for (const auto& [ends, point] : midpoints)
    if (const auto edge = edges.find(ends); edge != edges.end()) nodes_.col(edge->second) = point;

  // Straightening one element bends its neighbours back, so that a few passes may be needed.
  for (bool changed = !midpoints.empty(); changed;) {
    changed = false;
    for (int t = 0; t < mesh.num_tets(); ++t) {
      if (!turned_over(t)) continue;
      changed = true;
      for (int e = 0; e < 6; ++e)
        nodes_.col(elements_(4 + e, t)) =
            0.5 * (nodes_.col(elements_(kEdges[e][0], t)) + nodes_.col(elements_(kEdges[e][1], t)));
    }
  }
}

bool LagrangeBasis::turned_over(int tet) const {
  static const TetRule rule = tet_rule(4);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    if (jacobian(tet, rule.barycentric.col(q)).determinant() <= 0) return true;
  return false;
}

Eigen::Matrix4Xd LagrangeBasis::node_barycentric() const {
  Eigen::Matrix4Xd out(4, elements_.rows());
  out.leftCols<4>().setIdentity();
  for (Eigen::Index e = 4; e < out.cols(); ++e)
    out.col(e) = 0.5 * (out.col(kEdges[e - 4][0]) + out.col(kEdges[e - 4][1]));
  return out;
}

void LagrangeBasis::shape(const Vec4& l, Vector& N, Eigen::MatrixX4d& derivative) const {
  if (order_ == 1) {
    N = l;
    derivative.setIdentity(4, 4);
    return;
  }
  N.resize(10);
  derivative.setZero(10, 4);
  for (int k = 0; k < 4; ++k) {
    N[k] = l[k] * (2 * l[k] - 1);
    derivative(k, k) = 4 * l[k] - 1;
  }
  for (int e = 0; e < 6; ++e) {
    const auto [a, b] = kEdges[e];
    N[4 + e] = 4 * l[a] * l[b];
    derivative(4 + e, a) = 4 * l[b];
    derivative(4 + e, b) = 4 * l[a];
  }
}

namespace {

Mat3 jacobian_of(const Points& nodes, const Eigen::MatrixXi& elements, int tet,
                 const Eigen::MatrixX4d& derivative) {
  Eigen::Matrix<double, 3, 4> by_barycentric = Eigen::Matrix<double, 3, 4>::Zero();
  for (Eigen::Index k = 0; k < elements.rows(); ++k)
    by_barycentric += nodes.col(elements(k, tet)) * derivative.row(k);
  return by_barycentric.rightCols<3>().colwise() - by_barycentric.col(0);
}

}  // namespace

Vec3 LagrangeBasis::position(int tet, const Vec4& barycentric) const {
  Vector N;
  Eigen::MatrixX4d derivative;
  shape(barycentric, N, derivative);
  return nodes_(Eigen::all, elements_.col(tet)) * N;
}

Points LagrangeBasis::positions(const std::vector<int>& tet, const Eigen::Matrix4Xd& barycentric) const {
  Points out(3, barycentric.cols());
  for (Eigen::Index q = 0; q < out.cols(); ++q) out.col(q) = position(tet[q], barycentric.col(q));
  return out;
}

Mat3 LagrangeBasis::jacobian(int tet, const Vec4& barycentric) const {
  Vector N;
  Eigen::MatrixX4d derivative;
  shape(barycentric, N, derivative);
  return jacobian_of(nodes_, elements_, tet, derivative);
}

double LagrangeBasis::interpolate(const Vector& nodal, int tet, const Vec4& barycentric) const {
  Vector N;
  Eigen::MatrixX4d derivative;
  shape(barycentric, N, derivative);
  return N.dot(nodal(elements_.col(tet)));
}

BasisSample LagrangeBasis::sample(int tet, const Vec4& barycentric) const {
  BasisSample out;
  Eigen::MatrixX4d derivative;
  shape(barycentric, out.N, derivative);
  const Mat3 inverse = jacobian_of(nodes_, elements_, tet, derivative).inverse();
  const Eigen::MatrixX3d by_xi = derivative.rightCols<3>().colwise() - derivative.col(0);
  out.gradient = (by_xi * inverse).transpose();
  out.functions.assign(elements_.col(tet).begin(), elements_.col(tet).end());
  return out;
}

WallPoints LagrangeBasis::wall_points(int degree) const {
  return wall_points([rule = tet_rule(degree)](int) { return rule; });
}

WallPoints LagrangeBasis::wall_points(const std::function<TetRule(int)>& rule) const {
  const auto elements = static_cast<int>(elements_.cols());
  std::vector<TetRule> rules;
  WallPoints out;
  out.starts.push_back(0);
  for (int t = 0; t < elements; ++t) {
    rules.push_back(rule(t));
    out.tet.insert(out.tet.end(), rules.back().weights.size(), t);
    out.starts.push_back(static_cast<int>(out.tet.size()));
  }
  out.barycentric.resize(4, out.starts.back());
  out.weights.resize(out.starts.back());
  for (int t = 0; t < elements; ++t)
    for (Eigen::Index k = 0; k < rules[t].weights.size(); ++k) {
      const Eigen::Index q = out.starts[t] + k;
      out.barycentric.col(q) = rules[t].barycentric.col(k);
      out.weights[q] = rules[t].weights[k] * jacobian(t, out.barycentric.col(q)).determinant() / 6;
    }
  return out;
}

SurfacePoints LagrangeBasis::surface_points(const TetMesh& mesh, const std::vector<int>& labels,
                                            int degree) const {
  return surface_points(mesh, labels,
                        [rule = triangle_rule(degree)](int, const FaceCorners&) { return rule; });
}

SurfacePoints LagrangeBasis::surface_points(
    const TetMesh& mesh, const std::vector<int>& labels,
    const std::function<TriangleRule(int, const FaceCorners&)>& rule_of) const {
  SurfacePoints out;
  std::vector<double> weights;
  std::vector<Vec4> barycentric;
  std::vector<std::array<Vec3, 3>> frames;
  out.starts.push_back(0);
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f) {
    if (std::find(labels.begin(), labels.end(), mesh.boundary_labels()[f]) == labels.end()) continue;
    const int tet = mesh.boundary_tets()[f];
    std::array<int, 3> corner{};
    FaceCorners corners = FaceCorners::Zero();
    for (int k = 0; k < 3; ++k) {
      corner[k] = local_vertex(mesh, tet, mesh.boundary()(k, f));
      corners(corner[k], k) = 1;
    }
    const TriangleRule rule = rule_of(tet, corners);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Vec4 l = corners * rule.barycentric.col(q);
      Vector N;
      Eigen::MatrixX4d derivative;
      shape(l, N, derivative);
      Vec3 X = Vec3::Zero();
      Eigen::Matrix<double, 3, 4> tangent = Eigen::Matrix<double, 3, 4>::Zero();
      for (Eigen::Index k = 0; k < elements_.rows(); ++k) {
        X += N[k] * nodes_.col(elements_(k, tet));
        tangent += nodes_.col(elements_(k, tet)) * derivative.row(k);
      }
      frames.push_back({X, tangent.col(corner[1]) - tangent.col(corner[0]),
                        tangent.col(corner[2]) - tangent.col(corner[0])});
      weights.push_back(rule.weights[q] / 2);
      barycentric.push_back(l);
      out.tet.push_back(tet);
    }
    out.starts.push_back(static_cast<int>(out.tet.size()));
  }
  const auto n = static_cast<Eigen::Index>(weights.size());
  out.weights = Eigen::Map<const Vector>(weights.data(), n);
  out.barycentric.resize(4, n);
  out.X.resize(3, n);
  out.X_xi.resize(3, n);
  out.X_eta.resize(3, n);
  for (Eigen::Index q = 0; q < n; ++q) {
    out.barycentric.col(q) = barycentric[q];
    out.X.col(q) = frames[q][0];
    out.X_xi.col(q) = frames[q][1];
    out.X_eta.col(q) = frames[q][2];
  }
  return out;
}

std::vector<int> LagrangeBasis::surface_nodes(const TetMesh& mesh, const std::vector<int>& labels) const {
  std::vector<int> out;
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f) {
    if (std::find(labels.begin(), labels.end(), mesh.boundary_labels()[f]) == labels.end()) continue;
    const int tet = mesh.boundary_tets()[f];
    std::array<bool, 4> on_face{};
    for (int k = 0; k < 3; ++k) on_face[local_vertex(mesh, tet, mesh.boundary()(k, f))] = true;
    for (int k = 0; k < 4; ++k)
      if (on_face[k]) out.push_back(elements_(k, tet));
    if (order_ == 2)
      for (int e = 0; e < 6; ++e)
        if (on_face[kEdges[e][0]] && on_face[kEdges[e][1]]) out.push_back(elements_(4 + e, tet));
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace polyaffine
