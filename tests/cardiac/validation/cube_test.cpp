#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <cardiac/validation/cube_figure.hpp>
#include <cardiac/validation/cube_platens.hpp>
#include <cardiac/validation/cube_table.hpp>

#include "support/labelled_box.hpp"

namespace cardiac {
namespace {

using polyaffine::Vec3;

CubeScene make_scene(int cells) {
  return CubeScene(polyaffine::testing::labelled_box(Vec3::Zero(), Vec3::Constant(kCubeSize),
                                                     Eigen::Vector3i::Constant(cells), 0.2));
}

const PaperCell kCell{5, 200, 0.575, 3.796, 9.864};

TEST(CubeTable, HasThePapersCells) {
  ASSERT_EQ(paper_table().size(), 15);
  EXPECT_NEAR(paper_table()[6].time_ratio(), 0.891 / 2.41, 1e-15);
  for (const PaperCell& cell : paper_table()) EXPECT_EQ(cell.zones == 1, cell.spread_percent == 0);
}

TEST(CubeTable, ConsistentWeightsEndTheTiltThatVolumesMake) {
  const CubeScene scene = make_scene(6);
  EXPECT_NEAR(solve_cube_fem(scene, 1).thickness.change, exact_thickness_change(), 1e-10);
  CubeTable table;
  const std::vector<CubeMethod> methods{
      {}, {CubeKinematics::blending, 1}, {CubeKinematics::gmls, 0}, {CubeKinematics::gmls, 1}};
  run_cube_cell(scene, kCell, methods, 3, table);
  ASSERT_EQ(table.rows.size(), 8);
  for (const CubeMethod& method : methods) {
    const CubeRow& before = table.row(kCell, method, CubeWeights::volumes);
    const CubeRow& after = table.row(kCell, method, CubeWeights::consistent);
    EXPECT_GT(before.tilt_percent, 1e-2);
    EXPECT_GT(before.worst_percent, 1e-2);
    EXPECT_LT(after.tilt_percent, 1e-9);
    EXPECT_LT(after.worst_percent, 1e-9);
    EXPECT_EQ(before.correction_s, 0);
    EXPECT_GT(after.time_ratio, 0);
  }
  ASSERT_EQ(table.defects.size(), 3);
  for (const CubeDefect& d : table.defects) {
    EXPECT_GT(d.defect, 1e-3);
    EXPECT_LT(d.unexplained, 1e-8);
  }
  const std::string csv = cube_csv(table);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 9);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 9 * 19);
  EXPECT_NE(csv.find("5,200,gmls,1,consistent,3,"), std::string::npos);
}

TEST(CubeTable, OneZoneIsExactWithAnyWeights) {
  const CubeScene scene = make_scene(4);
  CubeTable table;
  run_cube_cell(scene, paper_table()[0], {{}}, 2, table);
  for (const CubeRow& row : table.rows) EXPECT_LT(row.worst_percent, 1e-10);
  EXPECT_TRUE(table.defects.empty());
}

TEST(CubeFigure, ShowsAllCurvesOfAFullTable) {
  CubeTable table;
  for (const PaperCell& cell : paper_table())
    for (const CubeWeights weights : {CubeWeights::volumes, CubeWeights::consistent}) {
      CubeRow row;
      row.paper = cell;
      row.weights = weights;
      row.tilt_percent = weights == CubeWeights::volumes ? 2.5 : 3e-13;
      table.rows.push_back(row);
    }
  const std::string svg = cube_svg(table);
  EXPECT_NE(svg.find("consistent weights, at most 3e-13 %"), std::string::npos);
  EXPECT_NE(svg.find("region volumes as weights, at most 2.5 %"), std::string::npos);
  EXPECT_NE(svg.find("paper (±), at most 9.9 %"), std::string::npos);
  std::size_t lines = 0;
  for (std::size_t at = svg.find("<polyline"); at != std::string::npos; at = svg.find("<polyline", at + 1))
    ++lines;
  EXPECT_EQ(lines, 6);
}

TEST(CubeThickness, TiltIsHalfOfBothSlopes) {
  const CubeThickness a{3, 1, -2}, b{1, 0.5, 2};
  EXPECT_EQ(a.tilt(), 1.5);
  EXPECT_EQ((a - b).change, 2);
  EXPECT_EQ((a - b).tilt(), 2.25);
}

TEST(Platens, LinearTetsLockAndZonesApproachQuadraticOnes) {
  const CubeScene scene = make_scene(6);
  const PlatenSolution linear = solve_platens_linear(scene), truth = solve_platens_quadratic(scene);
  EXPECT_LT(truth.thickness_change_mm, 1.1 * linear.thickness_change_mm);
  EXPECT_GT(truth.thickness_change_mm, exact_thickness_change());  // platens stiffen
  const PlatenRow one = compare_platens(scene, truth, 1, 600, 1),
                  nine = compare_platens(scene, truth, 9, 600, 2);
  EXPECT_LT(one.thickness_error_percent, 10);
  EXPECT_LT(nine.thickness_error_percent, 0.8 * one.thickness_error_percent);
  EXPECT_LT(nine.displacement_error_percent, 0.8 * one.displacement_error_percent);
  EXPECT_EQ(nine.unknowns, 108);
}

TEST(Platens, NothingSlips) {
  const CubeScene scene = make_scene(4);
  std::mt19937_64 random(3);
  const CubePlacement placement = place_cube(scene, 2, 100, random);
  const auto basis = platen_basis(scene, placement);
  for (const int label : {kCubeBottom, kCubeTop}) {
    const auto face = scene.face(*scene.quadratic, label);
    for (Eigen::Index q = 0; q < face.weights.size(); ++q) {
      const polyaffine::BasisSample s = basis->sample(face.tet[q], face.barycentric.col(q));
      for (std::size_t k = 0; k + 1 < s.functions.size(); ++k)
        EXPECT_LT(std::abs(s.N[static_cast<Eigen::Index>(k)]), 1e-14);
      EXPECT_NEAR(s.N[s.N.size() - 1], label == kCubeTop ? 1 : 0, 1e-14);
    }
  }
}

}  // namespace
}  // namespace cardiac
