#include "polyaffine/quadrature/cell_gauss.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>

#include "support/labelled_box.hpp"

namespace polyaffine {
namespace {

constexpr CellDegree kOtherwise{2, 2, 2};

// Gauss points of a cube, sorted into cells by a function of the position.
struct Cells {
  TetMesh mesh;
  std::function<CellPlace(const Vec3&)> place;
  LagrangeBasis basis{mesh, 1};
  WallPoints candidates = basis.wall_points(6);
  std::vector<int> cell;
  Points coordinates{3, candidates.barycentric.cols()};
  PlaceOf place_of = [this](int tet, const Vec4& l) { return place(basis.position(tet, l)); };

  Cells(const TetMesh& m, std::function<CellPlace(const Vec3&)> p) : mesh(m), place(std::move(p)) {
    for (Eigen::Index q = 0; q < coordinates.cols(); ++q) {
      const CellPlace at = place_of(candidates.tet[q], candidates.barycentric.col(q));
      cell.push_back(at.cell);
      coordinates.col(q) = at.place;
    }
  }
  Cells(const Cells&) = delete;
  Cells& operator=(const Cells&) = delete;
  WallPoints rule(const CellCounts& counts) const {
    return gauss_cells(
        candidates, cell, coordinates, place_of, [&](int) { return counts; }, kOtherwise);
  }
};

// Cells 1 and 3 on both sides of x = 0.5, in coordinates in which the volume is not evenly spread.
CellPlace two_cells(const Vec3& X) {
  const bool right = X.x() > 0.5;
  const double x = right ? 2 * X.x() - 1 : 2 * X.x();
  return {right ? 3 : 1, Vec3(x * (1 + x) / 2, X.y(), std::sqrt(X.z()))};
}

TEST(CellGauss, PointsLieAtTheGaussPointsOfTheCoordinatesAndKeepTheMoments) {
  const Cells cells(testing::labelled_cube(4, 0.2), two_cells);
  const CellCounts counts{2, 3, 4};
  const WallPoints rule = cells.rule(counts);
  ASSERT_EQ(rule.starts, (std::vector<int>{0, 24, 48}));
  EXPECT_GT(rule.weights.minCoeff(), 0);
  const std::array<LineRule, 3> lines{line_rule(2), line_rule(3), line_rule(4)};
  for (int q = 0; q < 48; ++q) {
    const Vec4 l = rule.barycentric.col(q);
    EXPECT_GE(l.minCoeff(), -1e-9);
    const CellPlace at = cells.place_of(rule.tet[q], l);
    EXPECT_EQ(at.cell, q < 24 ? 1 : 3);
    const int i = q % 24 / 12, j = q % 12 / 4, k = q % 4;
    const Vec3 gauss(lines[0].points[i], lines[1].points[j], lines[2].points[k]);
    EXPECT_LT((at.place - gauss).norm(), 1e-8);
  }
  for (int c = 0; c < 2; ++c)
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 3; ++b)
        for (int d = 0; d < 4; ++d) {
          double exact = 0, found = 0;
          const auto monomial = [&](const Vec3& x) {
            return std::pow(x[0], a) * std::pow(x[1], b) * std::pow(x[2], d);
          };
          for (Eigen::Index q = 0; q < cells.coordinates.cols(); ++q)
            if (cells.cell[q] == 1 + 2 * c)
              exact += cells.candidates.weights[q] * monomial(cells.coordinates.col(q));
          for (int q = 24 * c; q < 24 * (c + 1); ++q)
            found += rule.weights[q] * monomial(cells.place_of(rule.tet[q], rule.barycentric.col(q)).place);
          EXPECT_NEAR(found, exact, 1e-9) << c << a << b << d;  // places are found to 1e-8
        }
}

// What the elements are does not matter where their rule integrates the moments exactly: here to the total
// degree 2 + 1 + 3.
TEST(CellGauss, DoesNotDependOnTheElements) {
  const auto place = [](const Vec3& X) { return CellPlace{0, X}; };
  const Cells even(testing::labelled_cube(2), place), finer(testing::labelled_cube(5, 0.3), place);
  const CellCounts counts{3, 2, 4};
  const WallPoints a = even.rule(counts), b = finer.rule(counts);
  ASSERT_EQ(a.tet.size(), b.tet.size());
  EXPECT_LT((a.weights - b.weights).cwiseAbs().maxCoeff(), 1e-12);
  for (Eigen::Index q = 0; q < a.weights.size(); ++q)
    EXPECT_LT((even.basis.position(a.tet[q], a.barycentric.col(q)) -
               finer.basis.position(b.tet[q], b.barycentric.col(q)))
                  .norm(),
              1e-8);
}

TEST(CellGauss, ACellThatIsNoBoxIsCompressed) {
  // Cell 0 lies below the diagonal and has its wide side at y = 1 only; cell 1 is a box.
  const auto place = [](const Vec3& X) {
    if (X.z() > 0.5) return CellPlace{1, Vec3(X.x(), X.y(), 2 * X.z() - 1)};
    return X.x() < X.y() ? CellPlace{0, Vec3(X.x(), X.y(), 2 * X.z())}
                         : CellPlace{2, Vec3(X.x(), X.y(), 2 * X.z())};
  };
  const Cells cells(testing::labelled_cube(4, 0.1), place);
  const WallPoints rule = cells.rule({2, 2, 2});
  ASSERT_EQ(rule.starts.size(), 4U);
  EXPECT_EQ(rule.starts[1], 8);  // the box first
  EXPECT_GT(rule.weights.minCoeff(), 0);
  EXPECT_GE(rule.barycentric.minCoeff(), -1e-9);
  std::array<double, 3> volume{}, exact{};
  for (std::size_t q = 0; q < rule.tet.size(); ++q)
    volume[cells.place_of(rule.tet[q], rule.barycentric.col(static_cast<Eigen::Index>(q))).cell] +=
        rule.weights[static_cast<Eigen::Index>(q)];
  for (std::size_t q = 0; q < cells.cell.size(); ++q)
    exact[cells.cell[q]] += cells.candidates.weights[static_cast<Eigen::Index>(q)];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(volume[c], exact[c], 1e-11) << c;
}

TEST(CellGauss, SurfaceKeepsTheClosedIntegralOfTheNormalAndVectorAreas) {
  // A ball-like body from a cube; its six faces are cells.
  const TetMesh mesh = testing::mapped(testing::labelled_cube(6), [](const Vec3& X) {
    const Vec3 c = 2 * X - Vec3::Ones();
    return Vec3(c * (1 + 0.2 * c.squaredNorm()));
  });
  const LagrangeBasis basis(mesh, 1);
  const PlaceOf place_of = [&](int tet, const Vec4& l) {
    const Vec3 X = basis.position(tet, l);
    Eigen::Index d = 0;
    X.cwiseAbs().maxCoeff(&d);
    const Vec3 direction = X / std::abs(X[d]);
    return CellPlace{static_cast<int>(2 * d + (X[d] > 0 ? 1 : 0)),
                     Vec3((1 + direction[(d + 1) % 3]) / 2, (1 + direction[(d + 2) % 3]) / 2, 0)};
  };
  const SurfacePoints all = basis.surface_points(mesh, {1, 2, 3, 4, 5, 6}, 4);
  std::vector<int> cell;
  Matrix places(2, all.X.cols());
  for (Eigen::Index q = 0; q < all.X.cols(); ++q) {
    const CellPlace at = place_of(all.tet[q], all.barycentric.col(q));
    cell.push_back(at.cell);
    places.col(q) = at.place.head<2>();
  }
  const SurfacePoints rule = gauss_surface_cells(
      all, cell, places, place_of,
      [](int) {
        return CellCounts{3, 3, 1};
      },
      4, basis);
  ASSERT_EQ(rule.tet.size(), 54U);
  const auto area = [](const SurfacePoints& points, Eigen::Index q) {
    return Vec3(points.weights[q] * Vec3(points.X_xi.col(q)).cross(Vec3(points.X_eta.col(q))));
  };
  Vec3 closed = Vec3::Zero();
  double volume = 0, exact = 0;
  std::array<Vec3, 6> sums, expected;
  sums.fill(Vec3::Zero());
  expected.fill(Vec3::Zero());
  for (Eigen::Index q = 0; q < rule.X.cols(); ++q) {
    closed += area(rule, q);
    sums[static_cast<std::size_t>(q / 9)] += area(rule, q) * rule.X(0, q);
    volume += area(rule, q).dot(rule.X.col(q)) / 3;
    EXPECT_LT((basis.position(rule.tet[q], rule.barycentric.col(q)) - rule.X.col(q)).norm(), 1e-12);
  }
  for (Eigen::Index q = 0; q < all.X.cols(); ++q) {
    expected[cell[q]] += area(all, q) * all.X(0, q);
    exact += area(all, q).dot(all.X.col(q)) / 3;
  }
  EXPECT_LT(closed.norm(), 1e-12);
  // The surface of the mesh bends from face to face by a tenth, which three points a direction see evenly.
  EXPECT_NEAR(volume / exact, 1, 3e-3);
  for (std::size_t c = 0; c < 6; ++c)
    EXPECT_LT((sums[c] - expected[c]).norm(), 0.01 * expected[c].norm() + 0.02);
}

}  // namespace
}  // namespace polyaffine
