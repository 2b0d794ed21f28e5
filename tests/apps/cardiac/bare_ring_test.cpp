#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"
#include "support/mesh_writers.hpp"
#include "support/odd_walls.hpp"
#include "support/vtk_writers.hpp"

namespace {

using testing::AllOf;
using testing::HasSubstr;

// A wall of which endocardium and epicardium meet in the valve ring, at z = 17 mm about the z axis.
const auto kTold =
    AllOf(HasSubstr("meet in an edge without a base"), HasSubstr("a ring 151.7 mm long"),
          HasSubstr("about (0, 0, 17) mm, through ("), HasSubstr("cut the wall below the ring"));

const polyaffine::MeshData& wall() {
  static const polyaffine::MeshData out = testing_io::data_of(cardiac::odd_walls::tapered_to_ring(20));
  return out;
}

/// Refused with the place; "filled" in a message would say that it came too late.
void expect_told(const std::string& arguments) {
  const ProgramRun run = run_program(arguments);
  EXPECT_EQ(run.status, 2) << arguments;
  EXPECT_THAT(run.err, kTold) << arguments;
  EXPECT_THAT(run.out + run.err, testing::Not(HasSubstr("filled"))) << arguments;
}

TEST(BareRingOfAFile, IsToldBeforeASurfaceIsFilled) {
  const TemporaryFolder folder;
  const std::string vtp = (folder.path / "ring.vtp").string(), stl = (folder.path / "ring.stl").string();
  const std::string out = " --length-unit mm --out " + (folder.path / "out.vtu").string();
  polyaffine::MeshData surface = wall();
  surface.tets.resize(4, 0);
  testing_io::write_vtk_xml(vtp, surface, true);
  testing_io::write_stl(stl, surface, true);
  expect_told("mesh import " + vtp + out);
  expect_told("mesh import " + vtp + out + " --endo-label 1 --epi-label 2");
  expect_told("mesh import " + stl + out);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "out.vtu"));
}

TEST(BareRingOfAFile, IsToldOfTetrahedraByImportAndSegment) {
  const TemporaryFolder folder;
  const std::string labelled = (folder.path / "labelled.msh").string();
  const std::string plain = (folder.path / "plain.msh").string();
  testing_io::write_gmsh_4(labelled, wall(), true);
  polyaffine::MeshData without = wall();
  without.triangles.resize(3, 0);
  without.triangle_fields.clear();
  testing_io::write_gmsh_4(plain, without, true);
  for (const std::string& file : {labelled, plain}) {
    expect_told("mesh import " + file + " --length-unit mm --out " + (folder.path / "out.vtu").string());
    expect_told("segment " + file + " --scheme aha17 --length-unit mm --out " +
                (folder.path / "segments.vtu").string());
  }
}

}  // namespace
