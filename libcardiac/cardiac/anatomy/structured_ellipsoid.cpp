#include "cardiac/anatomy/structured_ellipsoid.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

// s: 0 apex to 1 base, psi: around the axis, t: depth.
struct Place {
  double s, psi, t;
};

// A shape whose base need not be plane.
struct Wall {
  TruncatedEllipsoid shape;
  double epi_base_z_mm;
};

Vec3 position(const Wall& wall, const Place& at) {
  const TruncatedEllipsoid& shape = wall.shape;
  const double r_s = shape.endo_short_mm + at.t * (shape.epi_short_mm - shape.endo_short_mm);
  const double r_l = shape.endo_long_mm + at.t * (shape.epi_long_mm - shape.endo_long_mm);
  const double base_z = shape.base_z_mm + at.t * (wall.epi_base_z_mm - shape.base_z_mm);
  const double theta = at.s * std::acos(-base_z / r_l);
  return {r_s * std::sin(theta) * std::cos(at.psi), r_s * std::sin(theta) * std::sin(at.psi),
          -r_l * std::cos(theta)};
}

Place middle(const Place& a, const Place& b) {
  const double turn = std::remainder(b.psi - a.psi, 2 * polyaffine::kPi);
  // On the axis the angle is that of the other end.
  const double psi = a.s == 0 ? b.psi : b.s == 0 ? a.psi : a.psi + turn / 2;
  return {(a.s + b.s) / 2, psi, (a.t + b.t) / 2};
}

void check_cells(const StructuredCells& cells) {
  if (cells.longitudinal >= 2 && cells.around >= 4 && cells.around % 2 == 0 && cells.through >= 1) return;
  throw polyaffine::InputError("cells of a structured ellipsoid: found " +
                               std::to_string(cells.longitudinal) + ", " + std::to_string(cells.around) +
                               ", " + std::to_string(cells.through) +
                               ", expected at least 2 from apex to base, an even number from 4 around and at "
                               "least 1 through the wall");
}

// Vertex of the (s, psi) surface: 0 at the apex, then ring after ring.
int surface_vertex(const StructuredCells& cells, int i, int j) {
  return i == 0 ? 0 : 1 + (i - 1) * cells.around + j % cells.around;
}

std::vector<std::array<int, 3>> surface_triangles(const StructuredCells& cells) {
  std::vector<std::array<int, 3>> out;
  for (int i = 0; i < cells.longitudinal; ++i)
    for (int j = 0; j < cells.around; ++j) {
      const int a = surface_vertex(cells, i, j), b = surface_vertex(cells, i, j + 1);
      const int c = surface_vertex(cells, i + 1, j), d = surface_vertex(cells, i + 1, j + 1);
      if (i == 0)
        out.push_back({a, c, d});
      else if ((i + j) % 2 == 0)
        out.insert(out.end(), {{a, b, c}, {b, c, d}});
      else
        out.insert(out.end(), {{a, b, d}, {a, c, d}});
    }
  for (auto& triangle : out) std::sort(triangle.begin(), triangle.end());
  return out;
}

}  // namespace

CurvedMesh structured_ellipsoid(const TruncatedEllipsoid& shape, const StructuredCells& cells,
                                std::optional<double> epi_base_z_mm) {
  const Wall wall{shape, epi_base_z_mm.value_or(shape.base_z_mm)};
  check_shape(shape);
  check_cells(cells);
  const int layer = 1 + cells.longitudinal * cells.around;
  std::vector<Place> places;
  for (int k = 0; k <= cells.through; ++k) {
    const double t = static_cast<double>(k) / cells.through;
    places.push_back({0, 0, t});
    for (int i = 1; i <= cells.longitudinal; ++i)
      for (int j = 0; j < cells.around; ++j)
        places.push_back(
            {static_cast<double>(i) / cells.longitudinal, 2 * polyaffine::kPi * j / cells.around, t});
  }
  Points points(3, static_cast<Eigen::Index>(places.size()));
  for (Eigen::Index p = 0; p < points.cols(); ++p) points.col(p) = position(wall, places[p]);

  std::vector<Eigen::Vector4i> tets;
  std::vector<std::pair<Eigen::Vector3i, int>> faces;
  for (int k = 0; k < cells.through; ++k)
    for (const auto& [a, b, c] : surface_triangles(cells)) {
      const int low = k * layer, high = low + layer;
      for (Eigen::Vector4i tet : {Eigen::Vector4i(low + a, low + b, low + c, high + c),
                                  Eigen::Vector4i(low + a, low + b, high + b, high + c),
                                  Eigen::Vector4i(low + a, high + a, high + b, high + c)}) {
        polyaffine::Mat3 edges;
        for (int e = 0; e < 3; ++e) edges.col(e) = points.col(tet[e + 1]) - points.col(tet[0]);
        if (edges.determinant() < 0) std::swap(tet[2], tet[3]);
        tets.push_back(tet);
      }
      if (k == 0) faces.push_back({{a, b, c}, kEndocardium});
      if (k + 1 == cells.through) faces.push_back({{high + a, high + b, high + c}, kEpicardium});
      if (b < layer - cells.around) continue;
      faces.push_back({{low + b, low + c, high + c}, kBase});
      faces.push_back({{low + b, high + b, high + c}, kBase});
    }
  polyaffine::Tets all(4, static_cast<Eigen::Index>(tets.size()));
  for (Eigen::Index t = 0; t < all.cols(); ++t) all.col(t) = tets[t];
  polyaffine::LabelledTriangles surface{polyaffine::Triangles(3, static_cast<Eigen::Index>(faces.size())),
                                        {}};
  for (std::size_t f = 0; f < faces.size(); ++f) {
    surface.triangles.col(static_cast<Eigen::Index>(f)) = faces[f].first;
    surface.labels.push_back(faces[f].second);
  }
  CurvedMesh out{polyaffine::TetMesh(points, all, {}, surface), {}};
  for (Eigen::Index t = 0; t < all.cols(); ++t)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        if (const int p = all(a, t), q = all(b, t); p < q)
          out.midpoints.try_emplace({p, q}, position(wall, middle(places[p], places[q])));
  return out;
}

}  // namespace cardiac
