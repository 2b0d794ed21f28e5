#include "cardiac/reduction/reduced_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <cardiac/strain/segment_strain.hpp>

#include "support/heart_run.hpp"
#include "support/random_vector.hpp"

namespace cardiac {
namespace {

using polyaffine::Matrix;
using polyaffine::Vector;

TEST(ReducedPoints, SegmentsAreAlikeWhereTheirFactorsAre) {
  auto protocol = testing::shipped_protocol("infarct_lv", {});
  const auto kinds = segment_kinds(protocol);
  ASSERT_EQ(kinds.size(), 29U);
  for (const auto& region : protocol.regions)
    for (const int s : region.segments) EXPECT_NE(kinds[s - 1], 0);
  EXPECT_EQ(std::count(kinds.begin(), kinds.end(), 0) + std::ssize(protocol.regions[0].segments), 29);
  protocol.regions[0].tension_factor = protocol.regions[0].stiffness_factor = 1;
  EXPECT_EQ(segment_kinds(protocol), std::vector<int>(29, 0));
}

// Some sectors of segments only touch a cell of two ventricles, whose angles are not quite those of the
// sectors.
TEST(ReducedPoints, FillTheWallWhereSectorsOnlyTouchACell) {
  Protocol protocol = testing::shipped_protocol(
      "healthy_biv",
      {"mesh.file=\"" PROJECT_DIR "/meshes/healthy_biv_coarse.vtu\"", "reduction.ring_nodes=[6,8,8]"});
  scene::RegionOverride scar;
  scar.segments = {7, 8};
  scar.stiffness_factor = 4;
  protocol.regions = {scar};
  const auto anatomy = testing::read_anatomy(protocol);
  const Discretisation d = reduced_discretisation(*anatomy, protocol);
  const double volume = anatomy->coordinates->space().wall_points(4).weights.sum();
  EXPECT_NEAR(d.points.weights.sum(), volume, 1e-9 * volume);
}

// Means over segments against those over the Gauss points of all elements.
TEST(ReducedPoints, StrainPointsGiveTheMeansOfSegments) {
  const Protocol protocol = testing::shipped_protocol("healthy_lv", testing::on_land_ellipsoid({}));
  const auto anatomy = testing::read_anatomy(protocol);
  const Discretisation d = reduced_discretisation(*anatomy, protocol);
  const Vector c = polyaffine::testing::random_vector(3 * d.basis->num_functions(), 0.3, 5);
  const auto strain = [&](const polyaffine::WallPoints& points) {
    const SegmentGauge gauge(*anatomy->coordinates, points);
    return gauge.green_lagrange(
        polyaffine::evaluate_field(polyaffine::deformation_table(*d.basis, points), c));
  };
  const auto exact = strain(anatomy->coordinates->space().wall_points(6));
  const auto found = strain(strain_points(*anatomy, d)), integrated = strain(d.points);
  double size = 0, error = 0, shared_out = 0;
  for (int s = 0; s < 16; ++s)
    for (int k = 0; k < 3; ++k) {
      size = std::max(size, std::abs(exact[s](k, k)));
      error = std::max(error, std::abs(found[s](k, k) - exact[s](k, k)));
      shared_out = std::max(shared_out, std::abs(integrated[s](k, k) - exact[s](k, k)));
    }
  EXPECT_GT(size, 0.04);
  EXPECT_LT(error, 0.03 * size);     // measured: 2 % against 26 %
  EXPECT_GT(shared_out, 5 * error);  // points of cells that lie in two segments
}

}  // namespace
}  // namespace cardiac
