#include "polyaffine/meshing/polyhedral_domain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <set>

#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/mesh/triangle_adjacency.hpp>
#include <polyaffine/meshing/thickness.hpp>

namespace polyaffine {
namespace {

struct Closed {
  Points points;
  Triangles triangles;
};

/// Two blocks of 14 × 20 × 20 mm joined by a plate of 12 × 20 × 3 mm in their middle: the outside of the
/// filled cells of a grid.
Closed blocks_and_plate() {
  constexpr std::array<double, 4> kX{0, 14, 26, 40}, kZ{0, 8.5, 11.5, 20};
  constexpr std::array<double, 2> kY{0, 20};
  const auto filled = [](const std::array<int, 3>& c) {
    return c[0] >= 0 && c[0] < 3 && c[1] == 0 && c[2] >= 0 && c[2] < 3 && (c[0] != 1 || c[2] == 1);
  };
  std::map<std::array<int, 3>, int> number;
  std::vector<std::array<int, 3>> faces;
  for (int x = 0; x < 3; ++x)
    for (int z = 0; z < 3; ++z)
      for (int axis = 0; axis < 3; ++axis)
        for (const int side : {0, 1}) {
          const std::array<int, 3> cell{x, 0, z};
          std::array<int, 3> beyond = cell;
          beyond.at(axis) += side == 1 ? 1 : -1;
          if (!filled(cell) || filled(beyond)) continue;
          std::array<int, 4> corner{};
          for (int k = 0; k < 4; ++k) {  // counter-clockwise seen from outside
            std::array<int, 3> at = cell;
            at.at(axis) += side;
            const int u = k == 1 || k == 2 ? 1 : 0, v = k >= 2 ? 1 : 0;
            at.at((axis + 1) % 3) += side == 1 ? u : v;
            at.at((axis + 2) % 3) += side == 1 ? v : u;
            corner.at(k) = number.try_emplace(at, static_cast<int>(number.size())).first->second;
          }
          faces.push_back({corner[0], corner[1], corner[2]});
          faces.push_back({corner[0], corner[2], corner[3]});
        }
  Closed out;
  out.points.resize(3, static_cast<Eigen::Index>(number.size()));
  for (const auto& [at, n] : number) out.points.col(n) = Vec3(kX.at(at[0]), kY.at(at[1]), kZ.at(at[2]));
  out.triangles.resize(3, static_cast<Eigen::Index>(faces.size()));
  for (std::size_t f = 0; f < faces.size(); ++f)
    out.triangles.col(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  return out;
}

TEST(Thickness, OfBlocksAndAPlate) {
  const Closed body = blocks_and_plate();
  const Vector thickness = thickness_behind(body.points, body.triangles);
  EXPECT_NEAR(thickness.minCoeff(), 3, 1e-12);
  EXPECT_NEAR(thickness.maxCoeff(), 40, 1e-12);
  const ThinPlace thin = thinnest_place(body.points, body.triangles);
  EXPECT_NEAR(thin.thickness_mm, 3, 1e-12);
  EXPECT_GT(thin.place.x(), 14);
  EXPECT_LT(thin.place.x(), 26);
}

TEST(PolyhedralDomain, ThinPartsGetSmallerTets) {
  const Closed body = blocks_and_plate();
  constexpr double kEdge = 5;  // of the blocks; more than the plate's thickness
  const TetMesh mesh = mesh_polyhedral_domain(body.points, body.triangles, sizes_for_edge(kEdge));
  EXPECT_NEAR(mesh.volume(), 2 * 14 * 20 * 20 + 12 * 20 * 3, 1e-6) << "flat sides are met exactly";
  const TriangleAdjacency adjacency = triangle_adjacency(mesh.boundary());
  EXPECT_TRUE(adjacency.crowded.empty());
  EXPECT_EQ(pinched_vertex(mesh.boundary(), adjacency.across), -1);
  const std::set<int> vertices(mesh.boundary().data(), mesh.boundary().data() + mesh.boundary().size());
  EXPECT_EQ(static_cast<Eigen::Index>(vertices.size()) - mesh.boundary().cols() / 2, 2) << "one ball";

  double plate = 0, blocks = 0;  // longest edges
  for (const auto& t : mesh.boundary().colwise())
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = mesh.points().col(t[k]), b = mesh.points().col(t[(k + 1) % 3]);
      const double x = (a.x() + b.x()) / 2;
      double& longest = x > 15 && x < 25 ? plate : blocks;
      longest = std::max(longest, (a - b).norm());
    }
  EXPECT_LT(plate, 4) << "about 2.1, .7 of the thickness";
  EXPECT_GT(blocks, 4);
}

}  // namespace
}  // namespace polyaffine
