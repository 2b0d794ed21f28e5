#include "polyaffine/mesh_io/closed_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/mesh/tet_faces.hpp>
#include <polyaffine/mesh/triangle_adjacency.hpp>
#include <polyaffine/mesh_io/assemble.hpp>

namespace polyaffine {
namespace {

[[noreturn]] void fail(const MeshData& data, const std::string& what) {
  throw InputError(data.source.string() + ": surface: " + what);
}

std::string place(const Vec3& x) {
  std::ostringstream out;
  out << '(' << x.x() << ", " << x.y() << ", " << x.z() << ") mm";
  return out.str();
}

std::string place(const MeshData& data, const std::array<int, 2>& edge) {
  return place((data.points.col(edge[0]) + data.points.col(edge[1])) / 2);
}

/// Leaves out triangles with two equal corners and repetitions.
void drop_collapsed(MeshData& data) {
  std::vector<std::pair<FaceKey, int>> keys;
  for (int t = 0; t < static_cast<int>(data.triangles.cols()); ++t) {
    const auto& v = data.triangles.col(t);
    if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) keys.emplace_back(face_key(v[0], v[1], v[2]), t);
  }
  const auto collapsed = data.triangles.cols() - static_cast<Eigen::Index>(keys.size());
  std::ranges::sort(keys);
  std::vector<int> kept;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (i == 0 || keys[i].first != keys[i - 1].first) kept.push_back(keys[i].second);
  std::ranges::sort(kept);
  if (collapsed > 0) data.notes.push_back(std::to_string(collapsed) + " triangles without area left out");
  if (const auto twice = keys.size() - kept.size(); twice > 0)
    data.notes.push_back(std::to_string(twice) + " repeated triangles left out");
  data.triangles = Triangles(data.triangles(Eigen::all, kept));
  for (auto& [name, field] : data.triangle_fields) field = Matrix(field(Eigen::all, kept));
}

/// Leaves out points of no triangle.
void drop_unused_points(MeshData& data) {
  std::vector<int> number(data.points.cols(), -1), kept;
  for (const int p : data.triangles.reshaped()) number[p] = 0;
  for (std::size_t p = 0; p < number.size(); ++p)
    if (number[p] == 0) {
      number[p] = static_cast<int>(kept.size());
      kept.push_back(static_cast<int>(p));
    }
  const auto unused = number.size() - kept.size();
  if (unused == 0) return;
  data.notes.push_back(std::to_string(unused) + " points of no triangle left out");
  for (int& p : data.triangles.reshaped()) p = number[p];
  data.points = Points(data.points(Eigen::all, kept));
  for (auto& [name, field] : data.point_fields) field = Matrix(field(Eigen::all, kept));
}

/// Turns triangles so that neighbours agree and all look outwards.
void orient(MeshData& data, const Triangles& across) {
  Triangles& t = data.triangles;
  std::vector<char> seen(t.cols(), 0);
  std::vector<int> front{0};
  seen[0] = 1;
  Eigen::Index turned = 0;
  const auto passes = [&](int f, int a, int b) {
    for (int k = 0; k < 3; ++k)
      if (t(k, f) == a && t((k + 1) % 3, f) == b) return true;
    return false;
  };
  while (!front.empty()) {
    const int f = front.back();
    front.pop_back();
    for (const int n : across.col(f)) {
      if (seen[n]) continue;
      seen[n] = 1;
      front.push_back(n);
      for (int k = 0; k < 3; ++k)
        if (passes(n, t(k, f), t((k + 1) % 3, f))) {
          std::swap(t(1, n), t(2, n));
          ++turned;
          break;
        }
    }
  }
  const auto opposed = triangle_adjacency(t).opposed;
  if (!opposed.empty())
    fail(data, "found a one-sided surface (near " + place(data, opposed.front()) +
                   "), expected the boundary of a body");
  if (EnclosedVolume(t).value(data.points) > 0) {
    t.row(1).swap(t.row(2));
    turned = t.cols() - turned;
  }
  if (turned > 0) data.notes.push_back(std::to_string(turned) + " triangles turned outwards");
}

}  // namespace

void make_closed_surface(MeshData& data) {
  if (data.tets.cols() > 0) fail(data, "found tetrahedra, expected triangles only");
  if (data.triangles.cols() == 0) fail(data, "found no triangles, expected a closed surface");
  join_points(data);
  drop_collapsed(data);
  drop_unused_points(data);
  if (data.triangles.cols() == 0) fail(data, "found only triangles without area, expected a closed surface");
  const TriangleAdjacency adjacency = triangle_adjacency(data.triangles);
  if (!adjacency.crowded.empty())
    fail(data, "found " + std::to_string(adjacency.crowded.size()) +
                   " edges of more than two triangles, one near " + place(data, adjacency.crowded.front()) +
                   ", expected two at every edge");
  if (!adjacency.open.empty())
    fail(data, "found " + std::to_string(adjacency.open.size()) + " edges of one triangle only, one near " +
                   place(data, adjacency.open.front()) + ", expected a closed surface without holes");
  const auto part = connected_parts(adjacency.across, [](int, int) { return true; });
  if (const auto other = std::ranges::find(part, 1); other != part.end())
    fail(data, "found " + std::to_string(1 + *std::ranges::max_element(part)) +
                   " separate surfaces, one near " +
                   place(data.points.col(data.triangles(0, other - part.begin()))) +
                   ", expected one that is the whole boundary of the wall");
  orient(data, adjacency.across);
  if (const int v = pinched_vertex(data.triangles, triangle_adjacency(data.triangles).across); v >= 0)
    fail(data, "found parts that touch in the point " + place(data.points.col(v)) +
                   " only, expected a manifold surface");
  const double volume = std::abs(EnclosedVolume(data.triangles).value(data.points));
  if (!(volume > 1e-6 * std::pow(triangle_areas(data.points, data.triangles).sum(), 1.5)))
    fail(data, "found a flat surface that encloses nothing, expected the boundary of a body");
}

}  // namespace polyaffine
