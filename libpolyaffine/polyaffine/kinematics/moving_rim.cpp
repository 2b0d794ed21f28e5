#include "polyaffine/kinematics/moving_rim.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>

namespace polyaffine {
namespace {

// What a unit of each component of each coefficient does at a point: displacement, and its derivative along a
// tangent, a column a component.
struct Motion {
  Mat3 value = Mat3::Zero(), along = Mat3::Zero();
};
using Motions = std::map<int, Motion>;

void add_motions(const Basis& basis, int tet, const Vec4& barycentric, const Vec3& tangent, double factor,
                 Motions& out) {
  const BasisSample s = basis.sample(tet, barycentric);
  Mat3 turning = Mat3::Zero();
  for (int J = 0; J < 3; ++J) turning += tangent[J] * s.dQ[static_cast<std::size_t>(J)];
  for (std::size_t k = 0; k < s.functions.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    const bool local = basis.in_local_axes(s.functions[k]);
    const double slope = s.gradient.col(at).dot(tangent);
    Motion& m = out[s.functions[k]];
    m.value += factor * s.N[at] * (local ? s.Q : Mat3::Identity());
    m.along += factor * (local ? Mat3(slope * s.Q + s.N[at] * turning) : Mat3(slope * Mat3::Identity()));
  }
  for (const auto& mode : s.modes) {
    Motion& m = out[mode.function];
    m.value += factor * mode.value;
    for (int k = 0; k < 3; ++k)
      m.along.col(k) += factor * mode.gradient.col(k).reshaped<Eigen::ColMajor>(3, 3) * tangent;
  }
}

Motions motions(const Basis& basis, const MeanPoint& mean) {
  Motions out;
  for (std::size_t i = 0; i < mean.tet.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    add_motions(basis, mean.tet[i], mean.barycentric.col(at), Vec3::Zero(), mean.weights[at], out);
  }
  return out;
}

std::vector<int> functions_of(const Motions& motions) {
  std::vector<int> out;
  for (const auto& [function, motion] : motions) out.push_back(function);
  return out;
}

// An edge of one face alone, in the sense of the face.
struct OpenEdge {
  int from = 0, to = 0, tet = 0;
};

std::vector<OpenEdge> open_edges(const TetMesh& mesh, const std::vector<int>& labels) {
  std::map<std::pair<int, int>, OpenEdge> found;
  std::set<std::pair<int, int>> closed;
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f) {
    if (std::ranges::find(labels, mesh.boundary_labels()[static_cast<std::size_t>(f)]) == labels.end())
      continue;
    for (int k = 0; k < 3; ++k) {
      const OpenEdge edge{mesh.boundary()(k, f), mesh.boundary()((k + 1) % 3, f),
                          mesh.boundary_tets()[static_cast<std::size_t>(f)]};
      const std::pair<int, int> key = std::minmax(edge.from, edge.to);
      if (!found.emplace(key, edge).second) closed.insert(key);
    }
  }
  std::vector<OpenEdge> out;
  for (const auto& [key, edge] : found)
    if (!closed.contains(key)) out.push_back(edge);
  return out;
}

Vec4 corner(const TetMesh& mesh, int tet, int vertex) {
  Vec4 out = Vec4::Zero();
  for (int k = 0; k < 4; ++k)
    if (mesh.tets()(k, tet) == vertex) out[k] = 1;
  return out;
}

EdgePoints edge_points(const LagrangeBasis& elements, const TetMesh& mesh,
                       const std::vector<OpenEdge>& edges) {
  const std::array<double, 2> places{0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)};
  const auto n = static_cast<Eigen::Index>(2 * edges.size());
  EdgePoints out{{}, Eigen::Matrix4Xd(4, n), Vector::Constant(n, 0.5), Points(3, n), Points(3, n)};
  Eigen::Index q = 0;
  for (const OpenEdge& edge : edges) {
    const Vec4 a = corner(mesh, edge.tet, edge.from), b = corner(mesh, edge.tet, edge.to);
    for (const double s : places) {
      out.tet.push_back(edge.tet);
      out.barycentric.col(q) = (1 - s) * a + s * b;
      out.X.col(q) = elements.position(edge.tet, out.barycentric.col(q));
      out.X_s.col(q) = elements.jacobian(edge.tet, out.barycentric.col(q)) * (b - a).tail<3>();
      ++q;
    }
  }
  return out;
}

// The vertices of a loop, each with half the length of its two edges.
MeanPoint mean_of(const TetMesh& mesh, const std::vector<int>& loop, const std::vector<OpenEdge>& edges) {
  std::map<int, double> share;
  std::map<int, int> tet_of;
  double length = 0;
  for (const OpenEdge& edge : edges) {
    if (std::ranges::find(loop, edge.from) == loop.end()) continue;
    const double l = (mesh.points().col(edge.to) - mesh.points().col(edge.from)).norm();
    for (const int vertex : {edge.from, edge.to}) {
      share[vertex] += l / 2;
      tet_of[vertex] = edge.tet;
    }
    length += l;
  }
  const auto n = std::ssize(share);
  MeanPoint out{{}, Eigen::Matrix4Xd(4, n), Vector(n), Points(3, n), Vec3::Zero()};
  for (const auto& [vertex, l] : share) {
    const auto at = static_cast<Eigen::Index>(out.tet.size());
    out.barycentric.col(at) = corner(mesh, tet_of[vertex], vertex);
    out.weights[at] = l / length;
    out.X.col(at) = mesh.points().col(vertex);
    out.position += l / length * mesh.points().col(vertex);
    out.tet.push_back(tet_of[vertex]);
  }
  return out;
}

}  // namespace

MovingRim moving_rim(const LagrangeBasis& elements, const TetMesh& mesh, const std::vector<int>& labels,
                     const Vec3& near) {
  const auto loops = rim_loops(mesh.surface(labels));
  if (loops.empty()) throw InputError("moving rim: found a closed surface, expected one with an opening");
  const std::vector<OpenEdge> edges = open_edges(mesh, labels);
  MovingRim out{{}, edge_points(elements, mesh, edges)};
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& loop : loops) {
    MeanPoint mean = mean_of(mesh, loop, edges);
    const double away = (mean.position - near).norm();
    if (away >= nearest) continue;
    nearest = away;
    out.centre = std::move(mean);
  }
  return out;
}

FieldTable surface_table(const Basis& basis, const SurfacePoints& points, const MeanPoint& origin) {
  const Motions moved = motions(basis, origin);
  FieldTable table = surface_table(basis, points, origin.position);
  FunctionGroup group;
  group.functions = functions_of(moved);
  group.d = 9;
  Matrix rows = Matrix::Zero(3 * std::ssize(group.functions), 9);
  Eigen::Index a = 0;
  for (const auto& [function, motion] : moved) rows.block<3, 3>(3 * a++, 0) = -motion.value.transpose();
  for (PointBlock& block : table.blocks) {
    group.modes = rows.replicate(1, block.count);
    block.groups.push_back(group);
  }
  return table;
}

FieldTable lid_table(const Basis& basis, const MovingRim& rim, const Vec3& origin) {
  const EdgePoints& edges = rim.edges;
  const Motions moved = motions(basis, rim.centre);
  const auto n = static_cast<Eigen::Index>(edges.tet.size());
  std::vector<Motions> at_points(edges.tet.size());
  std::set<int> all;
  for (const auto& [function, motion] : moved) all.insert(function);
  for (Eigen::Index q = 0; q < n; ++q) {
    Motions& own = at_points[static_cast<std::size_t>(q)];
    add_motions(basis, edges.tet[static_cast<std::size_t>(q)], edges.barycentric.col(q), edges.X_s.col(q), 1,
                own);
    for (const auto& [function, motion] : own) all.insert(function);
  }
  FunctionGroup group;
  group.functions.assign(all.begin(), all.end());
  group.d = 9;
  group.modes = Matrix::Zero(3 * std::ssize(group.functions), 9 * n);
  for (std::size_t a = 0; a < group.functions.size(); ++a) {
    const int function = group.functions[a];
    const auto centre = moved.find(function);
    const Mat3 of_centre = centre == moved.end() ? Mat3::Zero() : centre->second.value;
    for (Eigen::Index q = 0; q < n; ++q) {
      const auto own = at_points[static_cast<std::size_t>(q)].find(function);
      const Motion rim_motion = own == at_points[static_cast<std::size_t>(q)].end() ? Motion() : own->second;
      auto rows = group.modes.block<3, 9>(3 * static_cast<Eigen::Index>(a), 9 * q);
      rows.leftCols<3>() = of_centre.transpose();
      rows.middleCols<3>(3) = (rim_motion.value - of_centre).transpose();
      rows.rightCols<3>() = rim_motion.along.transpose();
    }
  }
  FieldTable table;
  table.num_functions = basis.num_functions();
  table.weights = 0.5 * edges.weights;
  table.base.resize(9, n);
  table.base.topRows<3>() = (rim.centre.position - origin).replicate(1, n);
  table.base.middleRows<3>(3) = edges.X.colwise() - rim.centre.position;
  table.base.bottomRows<3>() = edges.X_s;
  table.blocks.push_back({0, static_cast<int>(n), {std::move(group)}});
  return table;
}

FieldTable mean_motion_table(const Basis& basis, const MeanPoint& points, const Vec3& axis) {
  Motions mean, turning;  // of the latter n·(r × u) is the value of row 0
  double inertia = 0;
  for (std::size_t i = 0; i < points.tet.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const Vec3 arm = axis.cross(points.X.col(at) - points.position);  // n·(r × u) = (n × r)·u
    Motions own;
    add_motions(basis, points.tet[i], points.barycentric.col(at), Vec3::Zero(), points.weights[at], own);
    for (const auto& [function, motion] : own) {
      mean[function].value += motion.value;
      turning[function].value.row(0) += arm.transpose() * motion.value;
    }
    inertia += points.weights[at] * arm.squaredNorm();
  }
  FunctionGroup group;
  group.functions = functions_of(mean);
  group.d = 9;
  group.modes = Matrix::Zero(3 * std::ssize(group.functions), 9);
  Eigen::Index a = 0;
  for (const auto& [function, motion] : mean) {
    auto rows = group.modes.block<3, 9>(3 * a++, 0);
    rows.leftCols<3>() = motion.value.transpose();
    rows.middleCols<3>(3) = turning[function].value.row(0).transpose() * axis.transpose() / inertia;
  }
  FieldTable table;
  table.num_functions = basis.num_functions();
  table.weights = Vector::Ones(1);
  table.base = Matrix::Zero(9, 1);
  table.blocks.push_back({0, 1, {std::move(group)}});
  return table;
}

FieldTable joined(FieldTable table, const FieldTable& more) {
  const int first = table.num_points();
  Vector weights(first + more.num_points());
  weights << table.weights, more.weights;
  Matrix base(9, weights.size());
  base << table.base, more.base;
  table.weights = std::move(weights);
  table.base = std::move(base);
  for (PointBlock block : more.blocks) {
    block.first += first;
    table.blocks.push_back(std::move(block));
  }
  return table;
}

}  // namespace polyaffine
