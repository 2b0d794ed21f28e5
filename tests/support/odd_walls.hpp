#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <polyaffine/mesh/tet_faces.hpp>

/// Walls that are no truncated ellipsoids, made of the structured one.
namespace cardiac::odd_walls {

/// Of a half-closed ventricle about z: its own opening is a circle of radius 13.5 mm about (0, 0, 30).
inline constexpr TruncatedEllipsoid kDome{22, 38, 32, 48, 30};

/// The ventricle kDome with a second, smaller opening beside the first one, at +x: the sides of both are the
/// base.
inline polyaffine::TetMesh two_openings() {
  constexpr StructuredCells kCells{12, 16, 2};
  const polyaffine::TetMesh whole = structured_ellipsoid(kDome, kCells).mesh;
  const int prisms = kCells.around * (2 * kCells.longitudinal - 1);
  const auto cut = [&](int tet) {
    const int cell = (tet / 3 % prisms - kCells.around) / 2;  // from the second row up, two prisms each
    const int row = 1 + cell / kCells.around, column = cell % kCells.around;
    return tet / 3 % prisms >= kCells.around && row >= 9 && row < 11 &&
           (column < 1 || column >= kCells.around - 1);
  };
  std::map<polyaffine::FaceKey, int> label;
  for (Eigen::Index f = 0; f < whole.boundary().cols(); ++f) {
    const auto& t = whole.boundary().col(f);
    label[polyaffine::face_key(t[0], t[1], t[2])] = whole.boundary_labels()[f];
  }
  std::vector<int> kept, number(whole.num_points(), -1), used;
  for (int t = 0; t < whole.num_tets(); ++t)
    if (!cut(t)) kept.push_back(t);
  polyaffine::Tets tets = whole.tets()(Eigen::all, kept);
  for (const int p : tets.reshaped())
    if (number[p] < 0) {
      number[p] = static_cast<int>(used.size());
      used.push_back(p);
    }
  for (int& p : tets.reshaped()) p = number[p];
  const polyaffine::Points points = whole.points()(Eigen::all, used);
  polyaffine::LabelledTriangles surface{polyaffine::TetMesh(points, tets).boundary(), {}};
  for (const auto& t : surface.triangles.colwise()) {
    const auto found = label.find(polyaffine::face_key(used[t[0]], used[t[1]], used[t[2]]));
    surface.labels.push_back(found == label.end() ? static_cast<int>(kBase) : found->second);
  }
  return {points, tets, {}, surface};
}

/// A mesh with its points moved.
template <class Map>
polyaffine::TetMesh moved(const polyaffine::TetMesh& mesh, const Map& map) {
  polyaffine::Points points = mesh.points();
  for (Eigen::Index p = 0; p < points.cols(); ++p) points.col(p) = map(polyaffine::Vec3(points.col(p)));
  return {points, mesh.tets(), {}, {mesh.boundary(), mesh.boundary_labels()}};
}

/// The human ventricle with a base that is cut obliquely: z grows by x tan 14° at the base,
/// nothing at the apex of the cavity; the axis from apex to base centre stays z.
inline polyaffine::TetMesh oblique_base() {
  const TruncatedEllipsoid shape = human_lv();
  const double tangent = std::tan(14 * polyaffine::kPi / 180);
  return moved(structured_ellipsoid(shape, {10, 16, 2}).mesh, [&](const polyaffine::Vec3& x) {
    const double height = (x.z() + shape.endo_long_mm) / (shape.base_z_mm + shape.endo_long_mm);
    return polyaffine::Vec3(x.x(), x.y(), x.z() + tangent * x.x() * std::clamp(height, 0.0, 1.0));
  });
}

/// A ventricle without a base: over the last `taper_mm` below it the wall tapers towards its middle
/// surface, and endocardium and epicardium meet in the ring, a circle about the z axis at its height.
inline polyaffine::TetMesh tapered_to_ring(double taper_mm, const TruncatedEllipsoid& shape = human_lv()) {
  constexpr StructuredCells kCells{14, 24, 2};
  const polyaffine::TetMesh whole = structured_ellipsoid(shape, kCells).mesh;
  polyaffine::Points points = whole.points();
  const int layer = 1 + kCells.longitudinal * kCells.around, ring = layer - kCells.around;
  const auto joined = [&](int p) { return p % layer < ring ? p : p % layer + kCells.through / 2 * layer; };
  for (int p = 0; p < static_cast<int>(points.cols()); ++p) {
    const polyaffine::Vec3 x = whole.points().col(p), middle = whole.points().col(p % layer + layer);
    const double share = p % layer < ring ? std::min(1.0, (shape.base_z_mm - middle.z()) / taper_mm) : 0.0;
    points.col(p) = middle + share * (x - middle);
  }
  // What has two corners in one place has gone.
  const auto kept = [&](const auto& cells) {
    std::vector<int> out;
    for (Eigen::Index c = 0; c < cells.cols(); ++c) {
      std::set<int> corners;
      for (const int p : cells.col(c)) corners.insert(joined(p));
      if (std::ssize(corners) == cells.rows()) out.push_back(static_cast<int>(c));
    }
    return out;
  };
  polyaffine::Tets tets = whole.tets()(Eigen::all, kept(whole.tets()));
  polyaffine::LabelledTriangles surface;
  const std::vector<int> faces = kept(whole.boundary());
  surface.triangles = whole.boundary()(Eigen::all, faces);
  for (const int f : faces) surface.labels.push_back(whole.boundary_labels()[f]);
  std::vector<int> number(points.cols(), -1), used;
  const auto renumber = [&](int& p) {
    int& at = number[joined(p)];
    if (at < 0) {
      at = static_cast<int>(used.size());
      used.push_back(joined(p));
    }
    p = at;
  };
  for (int& p : tets.reshaped()) renumber(p);
  for (int& p : surface.triangles.reshaped()) renumber(p);
  return {points(Eigen::all, used), tets, {}, surface};
}

}  // namespace cardiac::odd_walls
