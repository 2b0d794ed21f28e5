#include "polyaffine/kinematics/lagrange.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>

#include <polyaffine/core/error.hpp>
#include <polyaffine/rules/gauss.hpp>

namespace polyaffine {
namespace {

constexpr std::array<std::array<int, 2>, 6> kEdges{{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};

int local_vertex(const TetMesh& mesh, int tet, int vertex) {
  for (int k = 0; k < 4; ++k)
    if (mesh.tets()(k, tet) == vertex) return k;
  return -1;
}

// One number for the edge between two vertices, whichever comes first.
std::uint64_t key_of(int a, int b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
}

// dX/dξ of ∂X/∂l, a column a barycentric coordinate; ξ are the last three.
Mat3 jacobian(const Eigen::Matrix<double, 3, 4>& by_barycentric) {
  return by_barycentric.rightCols<3>().colwise() - by_barycentric.col(0);
}

}  // namespace

LagrangeBasis::LagrangeBasis(const TetMesh& mesh, int order, const EdgeMidpoints& midpoints)
    : order_(order), nodes_(mesh.points()), elements_(mesh.tets()) {
  if (order != 1 && order != 2)
    throw InputError("element order: found " + std::to_string(order) + ", expected 1 or 2");
  if (order == 1) return;
  const EdgeNodes edges = add_edge_nodes(mesh);
  for (int t = 0; t < mesh.num_tets(); ++t) straighten(t);
  for (const auto& [ends, point] : midpoints)
    if (const auto edge = edges.find(key_of(ends.first, ends.second)); edge != edges.end())
      nodes_.col(edge->second) = point;
  if (midpoints.empty()) return;
  while (straighten_turned_over()) {
  }
}

bool LagrangeBasis::is_whole() const {
  if ((order_ != 1 && order_ != 2) || elements_.rows() != (order_ == 1 ? 4 : 10)) return false;
  return elements_.size() == 0 || (elements_.minCoeff() >= 0 && elements_.maxCoeff() < nodes_.cols());
}

// Numbers the edges as they are met, after the vertices.
LagrangeBasis::EdgeNodes LagrangeBasis::add_edge_nodes(const TetMesh& mesh) {
  EdgeNodes edges;
  edges.reserve(static_cast<std::size_t>(mesh.num_tets()) * 3 / 2);  // a mesh has about 1.2 edges a tet
  elements_.conservativeResize(10, Eigen::NoChange);
  for (int t = 0; t < mesh.num_tets(); ++t)
    for (int e = 0; e < 6; ++e) {
      const auto key = key_of(mesh.tets()(kEdges[e][0], t), mesh.tets()(kEdges[e][1], t));
      elements_(4 + e, t) =
          edges.try_emplace(key, mesh.num_points() + static_cast<int>(edges.size())).first->second;
    }
  nodes_.conservativeResize(Eigen::NoChange, mesh.num_points() + static_cast<Eigen::Index>(edges.size()));
  return edges;
}

void LagrangeBasis::straighten(int tet) {
  for (int e = 0; e < 6; ++e)
    nodes_.col(elements_(4 + e, tet)) =
        0.5 * (nodes_.col(elements_(kEdges[e][0], tet)) + nodes_.col(elements_(kEdges[e][1], tet)));
}

// Straightens the elements whose curved edges turn them over; whether there were any. That changes their
// neighbours, so that a few passes may be needed; in the end all edges are straight.
bool LagrangeBasis::straighten_turned_over() {
  bool changed = false;
  for (Eigen::Index t = 0; t < elements_.cols(); ++t) {
    if (!turned_over(static_cast<int>(t))) continue;
    changed = true;
    straighten(static_cast<int>(t));
  }
  return changed;
}

// By the Jacobian at Gauss points: it is a polynomial of degree three.
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

LagrangeBasis::Shape LagrangeBasis::shape(const Vec4& l) const {
  Shape out;
  if (order_ == 1) {
    out.N = l;
    out.derivative.setIdentity(4, 4);
    return out;
  }
  out.N.resize(10);
  out.derivative.setZero(4, 10);
  for (int k = 0; k < 4; ++k) {
    out.N[k] = l[k] * (2 * l[k] - 1);
    out.derivative(k, k) = 4 * l[k] - 1;
  }
  for (int e = 0; e < 6; ++e) {
    const auto [a, b] = kEdges[e];
    out.N[4 + e] = 4 * l[a] * l[b];
    out.derivative(a, 4 + e) = 4 * l[b];
    out.derivative(b, 4 + e) = 4 * l[a];
  }
  return out;
}

Eigen::Matrix<double, 3, 4> LagrangeBasis::tangents(int tet, const Shape& shape) const {
  Eigen::Matrix<double, 3, 4> out = Eigen::Matrix<double, 3, 4>::Zero();
  for (Eigen::Index k = 0; k < elements_.rows(); ++k) {
    const Vec3 x = nodes_.col(elements_(k, tet));
    const Vec4 d = shape.derivative.col(k);
    for (int j = 0; j < 4; ++j) out.col(j) += d[j] * x;
  }
  return out;
}

double ElementSample::value(const Vector& nodal) const {
  double out = 0;
  for (Eigen::Index a = 0; a < N.size(); ++a) out += N[a] * nodal[functions[a]];
  return out;
}

Vec3 ElementSample::slope(const Vector& nodal) const {
  Vec3 out = Vec3::Zero();
  for (Eigen::Index a = 0; a < N.size(); ++a) out += nodal[functions[a]] * gradient.col(a);
  return out;
}

Vec3 ElementSample::value(const Points& nodal) const {
  Vec3 out = Vec3::Zero();
  for (Eigen::Index a = 0; a < N.size(); ++a) out += N[a] * nodal.col(functions[a]);
  return out;
}

Vec3 LagrangeBasis::position(int tet, const Vec4& barycentric) const {
  const Shape s = shape(barycentric);
  Vec3 out = Vec3::Zero();
  for (Eigen::Index k = 0; k < elements_.rows(); ++k) out += s.N[k] * nodes_.col(elements_(k, tet));
  return out;
}

Points LagrangeBasis::positions(const std::vector<int>& tet, const Eigen::Matrix4Xd& barycentric) const {
  Points out(3, barycentric.cols());
  for (Eigen::Index q = 0; q < out.cols(); ++q) out.col(q) = position(tet[q], barycentric.col(q));
  return out;
}

Mat3 LagrangeBasis::jacobian(int tet, const Vec4& barycentric) const {
  return polyaffine::jacobian(tangents(tet, shape(barycentric)));
}

double LagrangeBasis::interpolate(const Vector& nodal, int tet, const Vec4& barycentric) const {
  const Shape s = shape(barycentric);
  double out = 0;
  for (Eigen::Index k = 0; k < elements_.rows(); ++k) out += s.N[k] * nodal[elements_(k, tet)];
  return out;
}

ElementSample LagrangeBasis::element_sample(int tet, const Vec4& barycentric) const {
  const Shape s = shape(barycentric);
  const auto by_barycentric = tangents(tet, s);
  // ∇l_k, a row each; the first one follows from Σ l = 1.
  Eigen::Matrix<double, 4, 3> by_X;
  by_X.bottomRows<3>() = polyaffine::jacobian(by_barycentric).inverse();
  by_X.row(0) = -by_X.bottomRows<3>().colwise().sum();
  ElementSample out;
  out.functions = elements_.col(tet);
  out.N = s.N;
  out.gradient.resize(3, s.N.size());
  for (Eigen::Index a = 0; a < s.N.size(); ++a) {
    const Vec4 d = s.derivative.col(a);
    out.gradient.col(a) = by_X.transpose() * d;
  }
  return out;
}

BasisSample LagrangeBasis::sample(int tet, const Vec4& barycentric) const {
  const ElementSample s = element_sample(tet, barycentric);
  BasisSample out;
  out.functions.assign(s.functions.begin(), s.functions.end());
  out.N = s.N;
  out.gradient = s.gradient;
  return out;
}

// The functions at the points of the rule are those of every element.
WallPoints LagrangeBasis::wall_points(int degree) const {
  const TetRule rule = tet_rule(degree);
  const Eigen::Index elements = elements_.cols(), n = rule.weights.size();
  std::vector<Shape> shapes;
  for (Eigen::Index k = 0; k < n; ++k) shapes.push_back(shape(rule.barycentric.col(k)));
  WallPoints out;
  out.barycentric = rule.barycentric.replicate(1, elements);
  out.weights.resize(n * elements);
  out.tet.reserve(static_cast<std::size_t>(n * elements));
  out.starts.push_back(0);
  for (int t = 0; t < static_cast<int>(elements); ++t) {
    for (Eigen::Index k = 0; k < n; ++k) {
      out.weights[n * t + k] =
          rule.weights[k] * polyaffine::jacobian(tangents(t, shapes[k])).determinant() / 6;
      out.tet.push_back(t);
    }
    out.starts.push_back(static_cast<int>(out.tet.size()));
  }
  return out;
}

WallPoints LagrangeBasis::wall_points(const std::function<TetRule(int)>& rule) const {
  const auto elements = static_cast<int>(elements_.cols());
  std::vector<double> barycentric, weights;
  WallPoints out;
  out.starts.push_back(0);
  for (int t = 0; t < elements; ++t) {
    const TetRule points = rule(t);
    for (Eigen::Index k = 0; k < points.weights.size(); ++k) {
      const Vec4 l = points.barycentric.col(k);
      barycentric.insert(barycentric.end(), l.begin(), l.end());
      weights.push_back(points.weights[k] * jacobian(t, l).determinant() / 6);
      out.tet.push_back(t);
    }
    out.starts.push_back(static_cast<int>(out.tet.size()));
  }
  out.barycentric = Eigen::Map<const Eigen::Matrix4Xd>(barycentric.data(), 4, out.starts.back());
  out.weights = Eigen::Map<const Vector>(weights.data(), out.starts.back());
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
      const auto tangent = tangents(tet, shape(l));
      frames.push_back({position(tet, l), tangent.col(corner[1]) - tangent.col(corner[0]),
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
