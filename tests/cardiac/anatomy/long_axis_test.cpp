#include "cardiac/anatomy/long_axis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/anatomy/orientation.hpp>
#include <cardiac/anatomy/segments.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/vtk/read.hpp>

#include "support/odd_walls.hpp"

namespace cardiac {
namespace {

using polyaffine::InputError;
using polyaffine::TetMesh;
using polyaffine::Vec3;
using testing::HasSubstr;
using testing::IsEmpty;

double angle_deg(const Vec3& a, const Vec3& b) {
  return std::acos(std::min(1.0, a.normalized().dot(b.normalized()))) * 180 / polyaffine::kPi;
}

TEST(LongAxis, OfAnObliqueBaseRunsFromApexToBaseCentre) {
  const TetMesh mesh = odd_walls::oblique_base();
  const LongAxis axis = find_long_axis(mesh, {}, {}, {});
  EXPECT_LT(angle_deg(axis.direction, Vec3::UnitZ()), 1);  // the apex of the polyhedron is not quite the axis
  EXPECT_NEAR(axis.base_angle_deg, 14, 1);
  EXPECT_FALSE(axis.normal_taken);
  const auto warnings = warnings_of(axis);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], testing::AllOf(HasSubstr("off the normal"), HasSubstr("anatomy.long_axis")));

  // Both sides of the plane of symmetry have the same segments; about the normal of the base 14 and 16 would
  // differ fifteenfold.
  const VentricularCoordinates c(mesh, SurfaceLabels{}, AnatomyOptions{});
  const auto volume = segment_volumes(mesh, segment_tets(mesh, c));
  EXPECT_NEAR(volume[13] / volume[15], 1, 0.15);
  EXPECT_THAT(warnings_of(find_long_axis(mesh, {}, Vec3(0, 0, 2), {})), IsEmpty()) << "it was chosen";
  EXPECT_THROW(find_long_axis(mesh, {}, Vec3(0, 0, -1), {}), InputError) << "from base to apex";
}

TEST(LongAxis, OfAFlatBaseAcrossItIsItsNormal) {
  for (const char* file : {"healthy_lv.vtu", "land_ellipsoid.vtu", "healthy_biv.vtu"}) {
    const TetMesh mesh = polyaffine::read_vtu(std::string(PROJECT_DIR "/meshes/") + file, 1);
    const LongAxis axis = find_long_axis(mesh, {}, {}, {});
    EXPECT_TRUE(axis.normal_taken) << file << ' ' << axis.base_angle_deg;
    EXPECT_LT(angle_deg(axis.direction, Vec3::UnitZ()), 1e-5) << file;
    EXPECT_THAT(warnings_of(axis), IsEmpty()) << file;
  }
}

TEST(LongAxis, RunsToTheMitralOneOfTwoOpenings) {
  const TetMesh mesh = odd_walls::two_openings();
  const LongAxis axis = find_long_axis(mesh, {}, {}, {});
  EXPECT_EQ(axis.openings, 2);
  EXPECT_FALSE(axis.mitral_known);
  EXPECT_LT((axis.base_centre - Vec3(0, 0, 30)).norm(), 1e-6) << "the larger one";
  EXPECT_LT(angle_deg(axis.direction, Vec3::UnitZ()), 1);
  EXPECT_THAT(notes_of(axis).back(), testing::AllOf(HasSubstr("2 openings"), HasSubstr("the largest")));

  const LongAxis other = find_long_axis(mesh, {}, {}, Vec3(25, 0, 20));
  EXPECT_TRUE(other.mitral_known);
  EXPECT_GT(other.base_centre.x(), 15);
}

TEST(LongAxis, TwoOpeningsAreBothTheBase) {
  const TetMesh mesh = odd_walls::two_openings();
  const VentricularCoordinates c(mesh, SurfaceLabels{}, AnatomyOptions{});
  const polyaffine::Vector u = c.apicobasal();
  for (const int n : c.space().surface_nodes(mesh, {kBase})) EXPECT_EQ(u[n], 1);
  EXPECT_LT(u.minCoeff(), 0.05);
  const auto volume = segment_volumes(mesh, segment_tets(mesh, c));
  // The second opening is cut out of the septum (+x), whose upper segments lose to their mirror images.
  EXPECT_LT(volume[1] + volume[2], 0.95 * (volume[4] + volume[5]));
  EXPECT_NEAR(volume[13] / volume[15], 1, 0.05);
  EXPECT_NEAR(volume[7] / volume[11], 1, 0.05);
}

TEST(Orientation, PointsTellWhereAnteriorIs) {
  const TetMesh mesh = structured_ellipsoid(land_ellipsoid(), {6, 12, 1}).mesh;
  const auto anterior = [&](const AnatomyOptions& options) {
    return VentricularCoordinates(mesh, SurfaceLabels{}, options).anterior();
  };
  AnatomyOptions septum, insertion;
  septum.septum_point = Vec3(0, -8, -3);  // a quarter turn from anterior, counter-clockwise from the apex
  EXPECT_LT((anterior(septum) - Vec3(1, 0, 0)).norm(), 1e-9);
  insertion.rv_insertion_point = 9 * Vec3(0.5, std::sqrt(0.75), 0);  // 30° from +y towards +x
  EXPECT_LT((anterior(insertion) - Vec3(0, 1, 0)).norm(), 1e-9);
  septum.septum_point = Vec3(0, 0, -18);
  EXPECT_THROW(anterior(septum), InputError) << "on the axis";
}

TEST(Orientation, AnAssumedAnteriorIsAWarning) {
  const auto warnings = [](const TetMesh& mesh, const AnatomyOptions& options) {
    return orientation_warnings(mesh, {}, VentricularCoordinates(mesh, SurfaceLabels{}, options));
  };
  for (const char* file : {"healthy_lv.vtu", "land_ellipsoid_coarse.vtu"})
    EXPECT_THAT(warnings(polyaffine::read_vtu(std::string(PROJECT_DIR "/meshes/") + file, 1), {}), IsEmpty())
        << file << " is the same all round";
  const TetMesh oval = odd_walls::moved(structured_ellipsoid(human_lv(), {8, 12, 1}).mesh,
                                        [](const Vec3& x) { return Vec3(1.1 * x.x(), x.y(), x.z()); });
  const auto assumed = warnings(oval, {});
  ASSERT_EQ(assumed.size(), 1U);
  EXPECT_THAT(assumed[0], testing::AllOf(HasSubstr("+y"), HasSubstr("anatomy.anterior_direction")));
  AnatomyOptions said;
  said.anterior = Vec3(0, 1, 0);
  EXPECT_THAT(warnings(oval, said), IsEmpty());
}

}  // namespace
}  // namespace cardiac
