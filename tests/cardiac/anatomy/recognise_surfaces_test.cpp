#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/recognise_surfaces.hpp>
#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/vtk/read.hpp>

#include "support/labelled_box.hpp"
#include "support/shuffled.hpp"

namespace cardiac {
namespace {

using polyaffine::TetMesh;
using testing::HasSubstr;

/// Share of the boundary's area that is not recognised as it is labelled.
double wrong_share(const TetMesh& mesh) {
  const RecognisedSurfaces found = recognise_surfaces(mesh);
  const polyaffine::Vector area = polyaffine::triangle_areas(mesh.points(), mesh.boundary());
  double wrong = 0;
  for (Eigen::Index f = 0; f < area.size(); ++f)
    if (found.labels[f] != mesh.boundary_labels()[f]) wrong += area[f];
  return wrong / area.sum();
}

TEST(RecogniseSurfaces, OfEllipsoidsInAnyPlace) {
  for (const char* file : {"healthy_lv.vtu", "land_ellipsoid.vtu", "land_ellipsoid_coarse.vtu"}) {
    const TetMesh mesh = polyaffine::read_vtu(std::string(PROJECT_DIR "/meshes/") + file, 1);
    EXPECT_EQ(wrong_share(mesh), 0) << file;
    EXPECT_EQ(wrong_share(shuffled(mesh, a_rotation(), {300, -20, 5})), 0) << file;
  }
}

TEST(RecogniseSurfaces, OfVeryCoarseAndCutOffShapes) {
  EXPECT_EQ(wrong_share(structured_ellipsoid(human_lv(), {4, 8, 1}).mesh), 0);
  // Cut below and above the equator: the cavity opens or closes towards the base.
  EXPECT_EQ(wrong_share(structured_ellipsoid({25, 60, 35, 70, -15}, {6, 12, 1}).mesh), 0);
  EXPECT_EQ(wrong_share(structured_ellipsoid({25, 60, 35, 70, 35}, {8, 12, 1}).mesh), 0);
}

TEST(RecogniseSurfaces, OfANoisyWall) {
  const TetMesh smooth = polyaffine::read_vtu(PROJECT_DIR "/meshes/healthy_lv.vtu", 1);
  polyaffine::Points points = smooth.points();
  std::srand(3);
  points += 0.4 * polyaffine::Points::Random(3, points.cols());
  const TetMesh noisy(points, smooth.tets(), {}, {smooth.boundary(), smooth.boundary_labels()});
  EXPECT_LT(wrong_share(noisy), 0.02);
}

TEST(RecogniseSurfaces, BodiesWithoutACavityAreRefused) {
  try {
    recognise_surfaces(polyaffine::testing::labelled_cube(3));
    FAIL();
  } catch (const polyaffine::InputError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(HasSubstr("no cavity"), HasSubstr("expected one or two ventricles")));
  }
}

TEST(RecogniseSurfaces, AClosedShellHasNoBase) {
  // A hollow cube: a box of 5 × 5 × 5 cells without the middle one.
  const TetMesh full = polyaffine::testing::labelled_cube(5);
  std::vector<int> kept;
  for (int t = 0; t < full.num_tets(); ++t)
    if ((full.tet_centroid(t).array() - 0.5).abs().maxCoeff() > 0.1) kept.push_back(t);
  const TetMesh shell(full.points(), full.tets()(Eigen::all, kept));
  try {
    recognise_surfaces(shell);
    FAIL();
  } catch (const polyaffine::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("closed cavity"));
  }
}

}  // namespace
}  // namespace cardiac
