#include "polyaffine/mesh/surface.hpp"

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

[[noreturn]] void open_cavity(const std::string& found, const std::string& expected) {
  throw InputError("open cavity: found " + found + ", expected " + expected);
}

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) {
  return a.dot(b.cross(c));
}

Vec3 centroid(const Points& points, const std::vector<int>& loop) {
  Vec3 sum = Vec3::Zero();
  for (const int i : loop) sum += points.col(i);
  return sum / static_cast<double>(loop.size());
}

Triangles nonempty_surface(const TetMesh& mesh, const std::vector<int>& labels) {
  Triangles triangles = mesh.surface(labels);
  if (triangles.cols() > 0) return triangles;
  std::string names;
  for (const int label : labels) names += (names.empty() ? "" : ", ") + std::to_string(label);
  const std::set<int> present(mesh.boundary_labels().begin(), mesh.boundary_labels().end());
  std::string found;
  for (const int label : present) found += (found.empty() ? "" : ", ") + std::to_string(label);
  open_cavity("no boundary triangle with the label " + names + " (labels in the mesh: " + found + ")",
              "a labelled surface around the cavity");
}

}  // namespace

Vector triangle_areas(const Points& points, const Triangles& triangles) {
  Vector areas(triangles.cols());
  for (Eigen::Index i = 0; i < triangles.cols(); ++i) {
    const Vec3 a = points.col(triangles(0, i));
    areas[i] = (points.col(triangles(1, i)) - a).cross(points.col(triangles(2, i)) - a).norm() / 2;
  }
  return areas;
}

double surface_area(const TetMesh& mesh, const std::vector<int>& labels) {
  return triangle_areas(mesh.points(), mesh.surface(labels)).sum();
}

std::vector<std::vector<int>> rim_loops(const Triangles& triangles) {
  if (triangles.cols() == 0) open_cavity("no triangles", "a surface around the cavity");
  std::set<std::pair<int, int>> edges;
  for (Eigen::Index i = 0; i < triangles.cols(); ++i)
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(k, i), b = triangles((k + 1) % 3, i);
      if (!edges.emplace(a, b).second)
        open_cavity("the edge between points " + std::to_string(a) + " and " + std::to_string(b) +
                        " twice in the same direction",
                    "a surface whose triangles agree in orientation, two at most at an edge");
    }
  std::map<int, int> next;
  for (const auto& [a, b] : edges) {
    if (edges.contains({b, a})) continue;
    if (!next.emplace(a, b).second)
      open_cavity("a rim that touches itself at point " + std::to_string(a), "rims that are simple loops");
  }
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    auto& loop = loops.emplace_back();
    for (auto it = next.begin(); it != next.end(); it = next.find(loop.back())) {
      if (loop.empty()) loop.push_back(it->first);
      const int to = it->second;
      next.erase(it);
      if (to == loop.front()) break;
      loop.push_back(to);
    }
  }
  return loops;
}

EnclosedVolume::EnclosedVolume(Triangles triangles)
    : triangles_(std::move(triangles)), rims_(rim_loops(triangles_)) {}

EnclosedVolume::EnclosedVolume(const TetMesh& mesh, const std::vector<int>& labels)
    : EnclosedVolume(nonempty_surface(mesh, labels)) {}

double EnclosedVolume::value(const Points& points) const {
  double sum = 0;
  for (const auto& t : triangles_.colwise())
    sum += determinant(points.col(t[0]), points.col(t[1]), points.col(t[2]));
  for (const auto& loop : rims_) {
    const Vec3 c = centroid(points, loop);
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum += determinant(points.col(loop[(i + 1) % loop.size()]), points.col(loop[i]), c);
  }
  return -sum / 6;
}

Points EnclosedVolume::gradient(const Points& points) const {
  Points out = Points::Zero(3, points.cols());
  for (const auto& t : triangles_.colwise())
    for (int k = 0; k < 3; ++k) {
      const Vec3 b = points.col(t[(k + 1) % 3]), c = points.col(t[(k + 2) % 3]);
      out.col(t[k]) -= b.cross(c) / 6;
    }
  for (const auto& loop : rims_) {
    const Vec3 c = centroid(points, loop);
    Vec3 at_centroid = Vec3::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int ia = loop[(i + 1) % loop.size()], ib = loop[i];
      const Vec3 a = points.col(ia), b = points.col(ib);
      out.col(ia) -= b.cross(c) / 6;
      out.col(ib) -= c.cross(a) / 6;
      at_centroid -= a.cross(b) / 6;
    }
    for (const int i : loop) out.col(i) += at_centroid / static_cast<double>(loop.size());
  }
  return out;
}

}  // namespace polyaffine
