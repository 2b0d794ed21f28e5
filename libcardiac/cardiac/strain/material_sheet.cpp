#include "cardiac/strain/material_sheet.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cardiac {

using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vector;

namespace {

Vec3 at(const EdgePoint& p, const Points& x) {
  return (1 - p.share) * x.col(p.from) + p.share * x.col(p.to);
}

double at(const EdgePoint& p, const Vector& field) {
  return (1 - p.share) * field[p.from] + p.share * field[p.to];
}

// Where a linear function that is `a` at `from` and `b` at `to`, of different signs, is zero.
EdgePoint crossing(int from, int to, double a, double b) {
  return {from, to, a / (a - b)};
}

}  // namespace

Points MaterialSheet::positions(const Points& x) const {
  Points out(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) out.col(static_cast<Eigen::Index>(i)) = at(points[i], x);
  return out;
}

double MaterialSheet::area(const Points& positions) const {
  double sum = 0;
  for (const auto& t : triangles) {
    const Vec3 a = positions.col(t[0]);
    sum += (positions.col(t[1]) - a).cross(positions.col(t[2]) - a).norm() / 2;
  }
  return sum;
}

MaterialSheet boundary_sheet(const polyaffine::TetMesh& mesh, const std::vector<int>& faces) {
  MaterialSheet out;
  std::vector<int> place(mesh.num_points(), -1);
  for (const int f : faces) {
    std::array<int, 3>& triangle = out.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.boundary()(k, f);
      if (place[v] < 0) {
        place[v] = static_cast<int>(out.points.size());
        out.points.push_back({v, v, 0});
      }
      triangle[k] = place[v];
    }
  }
  return out;
}

MaterialSheet level_sheet(const polyaffine::TetMesh& mesh, const std::vector<int>& tets, const Vector& field,
                          double level) {
  MaterialSheet out;
  for (const int t : tets) {
    std::vector<int> low, high;
    for (int k = 0; k < 4; ++k) {
      const int v = mesh.tets()(k, t);
      (field[v] < level ? low : high).push_back(v);
    }
    if (low.empty() || high.empty()) continue;
    const int first = static_cast<int>(out.points.size());
    // Corners in an order that goes round.
    std::vector<std::array<int, 2>> edges;
    if (low.size() == 2)
      edges = {{low[0], high[0]}, {low[0], high[1]}, {low[1], high[1]}, {low[1], high[0]}};
    else
      for (const int a : low)
        for (const int b : high) edges.push_back({a, b});
    for (const auto& [a, b] : edges) out.points.push_back(crossing(a, b, field[a] - level, field[b] - level));
    out.triangles.push_back({first, first + 1, first + 2});
    if (edges.size() == 4) out.triangles.push_back({first, first + 2, first + 3});
  }
  return out;
}

double MaterialLine::length(const Points& positions) const {
  double sum = 0;
  for (const auto& [a, b] : pieces) sum += (at(a, positions) - at(b, positions)).norm();
  return sum;
}

MaterialLine zero_line(const MaterialSheet& sheet, const Vector& field, double largest_jump) {
  std::vector<double> value;
  for (const EdgePoint& p : sheet.points) value.push_back(at(p, field));
  MaterialLine out;
  for (const auto& triangle : sheet.triangles) {
    const auto [low, high] = std::minmax({value[triangle[0]], value[triangle[1]], value[triangle[2]]});
    if (!(low < 0) || high < 0 || high - low > largest_jump) continue;
    std::vector<EdgePoint> ends;
    for (int k = 0; k < 3; ++k) {
      const int a = triangle[k];
      const int b = triangle[(k + 1) % 3];
      if ((value[a] < 0) != (value[b] < 0)) ends.push_back(crossing(a, b, value[a], value[b]));
    }
    out.pieces.push_back({ends[0], ends[1]});
  }
  return out;
}

}  // namespace cardiac
