#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/anatomy/bare_ring.hpp>
#include <cardiac/anatomy/check_surfaces.hpp>
#include <cardiac/anatomy/heart_mesh.hpp>
#include <cardiac/anatomy/recognise_surfaces.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/vtk/read.hpp>

#include "support/error_of.hpp"
#include "support/mesh_writers.hpp"
#include "support/odd_walls.hpp"
#include "support/shuffled.hpp"

namespace cardiac {
namespace {

using polyaffine::TetMesh;
using polyaffine::testing::error_of;
using testing::AllOf;
using testing::HasSubstr;

// The ring lies on the middle ellipsoid (semi-axes 25 and 68.5 mm) at z = 17 mm: a circle of radius
// 25 √(1 − (17/68.5)²) = 24.22 mm, as 24 chords 151.7 mm long.
const auto kRing = AllOf(HasSubstr("meet in an edge without a base"), HasSubstr("a ring 151.7 mm long"),
                         HasSubstr("no thickness"), HasSubstr("cut the wall below the ring"));

TEST(BareRing, OfLabelledSurfacesIsToldWithItsPlace) {
  const TetMesh mesh = odd_walls::tapered_to_ring(20);
  const auto check = [&] { check_bare_rings(mesh.points(), mesh.boundary(), mesh.boundary_labels()); };
  EXPECT_THAT(error_of(check), kRing);
  EXPECT_THAT(error_of(check), HasSubstr("about (0, 0, 17) mm, through ("));
  const auto heart = [&] { make_heart_mesh(testing_io::data_of(mesh), nullptr, {}); };
  EXPECT_THAT(error_of(heart), kRing) << "no label says base";
  const auto rest = [&] {
    HeartMeshOptions options;
    options.labels.rest_is_base = true;
    make_heart_mesh(testing_io::data_of(mesh), nullptr, options);
  };
  EXPECT_THAT(error_of(rest), kRing) << "there is no rest to be the base";
}

TEST(BareRing, OfPartOfTheRimIsToldToo) {
  const TetMesh mesh = odd_walls::tapered_to_ring(20);
  std::vector<int> labels = mesh.boundary_labels();
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f) {
    const polyaffine::Vec3 middle = mesh.points()(Eigen::all, mesh.boundary().col(f)).rowwise().mean();
    if (labels[f] == kEpicardium && middle.z() > 10 && middle.x() > 0) labels[f] = kBase;
  }
  const auto check = [&] { check_heart_surfaces(mesh.points(), mesh.boundary(), labels); };
  EXPECT_THAT(error_of(check), HasSubstr("found an edge "));
}

TEST(BareRing, IsRecognisedFromTheShape) {
  for (const double taper_mm : {10.0, 20.0, 40.0}) {
    const TetMesh mesh = odd_walls::tapered_to_ring(taper_mm);
    const auto check = [](const TetMesh& m) {
      return error_of([&] { check_tapered_rims(m.points(), m.boundary()); });
    };
    EXPECT_THAT(check(mesh), kRing) << taper_mm;
    EXPECT_THAT(check(shuffled(mesh, a_rotation(), {300, -20, 5})), kRing) << taper_mm;
    EXPECT_THAT(error_of([&] { recognise_surfaces(mesh); }), kRing) << taper_mm;
  }
}

// The outside of the dome faces its opening, so that it could pass for a base; ring: 24 chords of a circle of
// radius 27 √(1 − (30/43)²) = 19.34 mm.
TEST(BareRing, IsRecognisedWhereTheOutsideFacesTheOpening) {
  for (const double taper_mm : {10.0, 20.0, 40.0}) {
    const TetMesh mesh = odd_walls::tapered_to_ring(taper_mm, odd_walls::kDome);
    EXPECT_THAT(error_of([&] { recognise_surfaces(mesh); }),
                HasSubstr("a ring 121.2 mm long about (0, 0, 30)"))
        << taper_mm;
  }
}

TEST(BareRing, AbsentWhereTheWallHasABase) {
  const auto passes = [](const TetMesh& mesh) {
    check_heart_surfaces(mesh.points(), mesh.boundary(), mesh.boundary_labels());
    check_tapered_rims(mesh.points(), mesh.boundary());
  };
  EXPECT_NO_THROW(passes(structured_ellipsoid(human_lv(), {14, 24, 2}).mesh));
  // The flat base and the endocardium of the dome meet at 53°.
  EXPECT_NO_THROW(passes(structured_ellipsoid(odd_walls::kDome, {14, 24, 2}).mesh));
  EXPECT_NO_THROW(passes(odd_walls::two_openings()));
  EXPECT_NO_THROW(passes(odd_walls::oblique_base()));
  EXPECT_NO_THROW(passes(structured_ellipsoid(human_lv(), {4, 8, 1}).mesh));
  for (const char* file : {"healthy_lv.vtu", "healthy_biv.vtu", "land_ellipsoid_coarse.vtu"})
    EXPECT_NO_THROW(passes(polyaffine::read_vtu(std::string(PROJECT_DIR "/meshes/") + file, 1))) << file;
}

}  // namespace
}  // namespace cardiac
