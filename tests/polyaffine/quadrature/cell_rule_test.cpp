#include "polyaffine/quadrature/cell_rule.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>

#include <polyaffine/kinematics/lagrange.hpp>

#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

constexpr CellDegree kDegree{2, 2, 4};

// Gauss points of a cube in the four cells that x = 0.4 and y = 0.5 cut; cells 1, 3, 4 and 6, the others are
// empty.
struct Cells {
  TetMesh mesh = testing::labelled_cube(4, 0.2);
  WallPoints candidates = LagrangeBasis(mesh, 1).wall_points(4);
  std::vector<int> cell;
  Points coordinates{3, candidates.barycentric.cols()};

  Cells() {
    for (Eigen::Index q = 0; q < coordinates.cols(); ++q) {
      const Vec3 X = position(candidates, static_cast<int>(q));
      const bool right = X.x() > 0.4;
      const bool back = X.y() > 0.5;
      cell.push_back(1 + 2 * (right ? 1 : 0) + 3 * (back ? 1 : 0));
      coordinates.col(q) = local(X);
    }
  }
  Vec3 position(const WallPoints& points, int q) const {
    return mesh.points()(Eigen::all, mesh.tets().col(points.tet[q])) * points.barycentric.col(q);
  }
  static Vec3 local(const Vec3& X) {
    return {X.x() > 0.4 ? (X.x() - 0.4) / 0.6 : X.x() / 0.4, std::fmod(2 * X.y(), 1.0), X.z()};
  }
  // Σ w x^a y^b z^c of the points [begin, end).
  double moment(const WallPoints& points, int begin, int end, int a, int b, int c) const {
    double sum = 0;
    for (int q = begin; q < end; ++q) {
      const Vec3 x = local(position(points, q));
      sum += points.weights[q] * std::pow(x[0], a) * std::pow(x[1], b) * std::pow(x[2], c);
    }
    return sum;
  }
};

TEST(CellRule, KeepsTheMomentsOfEveryCellWithFewPositiveWeights) {
  const Cells cells;
  const WallPoints grouped = group_cells(cells.candidates, cells.cell);
  const WallPoints rule = compress_cells(cells.candidates, cells.cell, cells.coordinates, kDegree);
  ASSERT_EQ(rule.starts.size(), 5U);
  ASSERT_EQ(grouped.starts.size(), 5U);
  EXPECT_GT(rule.weights.minCoeff(), 0);
  EXPECT_NEAR(rule.weights.sum(), 1, 1e-11);
  double beyond = 0;
  for (int k = 0; k < 4; ++k) {
    int polynomials = 0;
    for (int a = 0; a <= 2; ++a)
      for (int b = 0; b <= 2; ++b)
        for (int c = 0; c <= 4; ++c) {
          const double exact = cells.moment(grouped, grouped.starts[k], grouped.starts[k + 1], a, b, c);
          const double found = cells.moment(rule, rule.starts[k], rule.starts[k + 1], a, b, c);
          if (a / 2.0 + b / 2.0 + c / 4.0 <= 1) {
            ++polynomials;
            EXPECT_NEAR(found, exact, 1e-11) << k << ": " << a << b << c;
          } else {
            beyond = std::max(beyond, std::abs(found - exact));
          }
        }
    EXPECT_LE(rule.starts[k + 1] - rule.starts[k], polynomials);
    EXPECT_GT(grouped.starts[k + 1] - grouped.starts[k], 10 * polynomials);
  }
  EXPECT_GT(beyond, 1e-7);  // what was not asked for is not kept
}

TEST(CellRule, CompressedSurfaceKeepsAreasAndVectorAreasOfEveryCell) {
  // The faces of a cube, cut at x = 0.4 into two cells that each go around it.
  const Cells cells;
  const SurfacePoints all = LagrangeBasis(cells.mesh, 1).surface_points(cells.mesh, {1, 2, 3, 4, 5, 6}, 4);
  std::vector<int> cell;
  Matrix place(2, all.X.cols());
  for (Eigen::Index q = 0; q < all.X.cols(); ++q) {
    cell.push_back(all.X(0, q) > 0.4 ? 1 : 0);
    place.col(q) << all.X(1, q), all.X(2, q);
  }
  const SurfacePoints rule = compress_surface_cells(all, cell, place, 4);
  ASSERT_EQ(rule.starts.size(), 3U);
  EXPECT_LT(rule.X.cols(), all.X.cols() / 4);
  EXPECT_GT(rule.weights.minCoeff(), 0);
  // Moments over the points with x on one side: ∫ y^a z^b dA and ∫ y^a z^b n dA.
  const auto moments = [](const SurfacePoints& points, bool right, int a, int b) {
    Vec4 sum = Vec4::Zero();
    for (Eigen::Index q = 0; q < points.X.cols(); ++q) {
      if ((points.X(0, q) > 0.4) != right) continue;
      const Vec3 n = Vec3(points.X_xi.col(q)).cross(Vec3(points.X_eta.col(q)));
      const double f = points.weights[q] * std::pow(points.X(1, q), a) * std::pow(points.X(2, q), b);
      sum += f * Vec4(n.norm(), n.x(), n.y(), n.z());
    }
    return sum;
  };
  for (const bool right : {false, true})
    for (int a = 0; a <= 4; ++a)
      for (int b = 0; a + b <= 4; ++b) {
        const Vec4 error = moments(rule, right, a, b) - moments(all, right, a, b);
        EXPECT_NEAR(error[0], 0, 1e-11) << a << b;
        if (a + b <= 2) {
          EXPECT_LT(error.norm(), 1e-11) << a << b;
        }
      }
}

TEST(CellRule, PointsStayInTheirCells) {
  const Cells cells;
  const WallPoints rule = compress_cells(cells.candidates, cells.cell, cells.coordinates, kDegree);
  for (int k = 0; k < 4; ++k) {
    const Vec3 first = cells.position(rule, rule.starts[k]);
    for (int q = rule.starts[k]; q < rule.starts[k + 1]; ++q) {
      const Vec3 X = cells.position(rule, q);
      EXPECT_EQ(X.x() > 0.4, first.x() > 0.4);
      EXPECT_EQ(X.y() > 0.5, first.y() > 0.5);
    }
  }
}

TEST(CellRule, GroupingOnlySorts) {
  const Cells cells;
  const WallPoints grouped = group_cells(cells.candidates, cells.cell);
  ASSERT_EQ(grouped.tet.size(), cells.candidates.tet.size());
  EXPECT_NEAR(grouped.weights.sum(), 1, 1e-13);
  EXPECT_NEAR(cells.moment(grouped, 0, static_cast<int>(grouped.tet.size()), 1, 2, 3),
              cells.moment(cells.candidates, 0, static_cast<int>(grouped.tet.size()), 1, 2, 3), 1e-13);
}

}  // namespace
}  // namespace polyaffine
