#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/anatomy/idealised.hpp>
#include <cmath>
#include <filesystem>
#include <polyaffine/mesh/quality.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/vtk/read.hpp>
#include <set>

#include "program.hpp"

namespace {

using cardiac::TruncatedEllipsoid;
using polyaffine::TetMesh;
using testing::AllOf;
using testing::HasSubstr;

/// Facts that hold for every mesh of a truncated ellipsoid.
void check_mesh(const TetMesh& mesh, const TruncatedEllipsoid& shape, double volume_tolerance) {
  EXPECT_EQ(mesh.surface({TetMesh::kUnlabelled}).cols(), 0) << "every boundary triangle has a label";
  const polyaffine::EnclosedVolume cavity(mesh, {cardiac::kEndocardium});
  EXPECT_EQ(cavity.rims().size(), 1U);
  const double exact = exact_cavity_volume(shape);
  EXPECT_LT(cavity.value(mesh.points()), exact) << "an inscribed polyhedron is smaller";
  EXPECT_GT(cavity.value(mesh.points()), (1 - volume_tolerance) * exact);
  EXPECT_NEAR(mesh.volume(), exact_wall_volume(shape), volume_tolerance * exact_wall_volume(shape));
  EXPECT_EQ(polyaffine::rim_loops(mesh.surface({cardiac::kBase})).size(), 2U) << "an annulus";
  EXPECT_GT(polyaffine::mesh_quality(mesh).min_dihedral_deg, 10);
  for (const int label : {cardiac::kEndocardium, cardiac::kEpicardium, cardiac::kBase})
    for (const int i : mesh.surface_points({label})) {
      const polyaffine::Vec3 x = mesh.points().col(i);
      EXPECT_LT((project_to_surface(shape, label, x) - x).norm(), 1e-9) << "on the exact surface";
    }
}

TEST(MeshCommand, ShippedMeshesAreWhatTheirNamesSay) {
  const std::string folder = PROJECT_DIR "/meshes/";
  // The gap between chords of length h and a surface of curvature radius R is h²/8R on each side: with h
  // about half the wall it stays below 2 % of the volumes, 4 % on the coarse mesh.
  const TetMesh human = polyaffine::read_vtu(folder + "healthy_lv.vtu", 1);
  check_mesh(human, cardiac::human_lv(), 0.02);
  EXPECT_GE(human.num_tets(), 5000);
  EXPECT_LE(human.num_tets(), 8000);
  check_mesh(polyaffine::read_vtu(folder + "land_ellipsoid.vtu", 1), cardiac::land_ellipsoid(), 0.02);
  check_mesh(polyaffine::read_vtu(folder + "land_ellipsoid_coarse.vtu", 1), cardiac::land_ellipsoid(), 0.04);
}

TEST(MeshCommand, BiventricleHasTwoCavitiesAndRegions) {
  const TemporaryFolder folder;
  const auto file = folder.path / "both.vtu";
  const auto run = run_program("mesh biventricle --size 7 --out " + file.string());
  if (run.status == 2 && run.err.find("without CGAL") != std::string::npos) GTEST_SKIP() << run.err;
  ASSERT_EQ(run.status, 0) << run.err;
  for (const auto& path : {file, std::filesystem::path(PROJECT_DIR "/meshes/healthy_biv.vtu")}) {
    SCOPED_TRACE(path);
    const TetMesh mesh = polyaffine::read_vtu(path, 1);
    EXPECT_EQ(mesh.surface({TetMesh::kUnlabelled}).cols(), 0);
    EXPECT_GT(polyaffine::mesh_quality(mesh).min_dihedral_deg, 8);
    const auto cavity_mL = [&](int label) {
      return polyaffine::EnclosedVolume(mesh, {label}).value(mesh.points()) / 1000;
    };
    EXPECT_NEAR(cavity_mL(cardiac::kEndocardium), 73, 2);
    EXPECT_NEAR(cavity_mL(cardiac::kRvEndocardium), 84, 2);
    EXPECT_EQ(std::set<int>(mesh.regions().begin(), mesh.regions().end()), (std::set<int>{1, 2, 3}));
  }
}

TEST(MeshCommand, EllipsoidWritesALabelledMeshAndPrintsItsNumbers) {
  const TemporaryFolder folder;
  const auto file = folder.path / "land.vtu";
  const auto run = run_program("mesh ellipsoid --shape land --size 2.5 --out " + file.string());
  if (run.status == 2 && run.err.find("without CGAL") != std::string::npos) GTEST_SKIP() << run.err;
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("tets"), HasSubstr("cavity_volume_mL"), HasSubstr("dihedral_angle_deg")));
  check_mesh(polyaffine::read_vtu(file, 1), cardiac::land_ellipsoid(), 0.04);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 1) << "no temporary file";
}

TEST(MeshCommand, AxesCanBeChosen) {
  const TemporaryFolder folder;
  const auto file = folder.path / "own.vtu";
  const auto run = run_program(
      "mesh ellipsoid --endo-short 15 --endo-long 30 --epi-short 25 --epi-long 40 --base-z 5 --size 7 "
      "--out " +
      file.string());
  if (run.status == 2 && run.err.find("without CGAL") != std::string::npos) GTEST_SKIP() << run.err;
  ASSERT_EQ(run.status, 0) << run.err;
  check_mesh(polyaffine::read_vtu(file, 1), {15, 30, 25, 40, 5}, 0.08);
}

TEST(MeshCommand, WrongInputIsStatusTwoAndTouchesNothing) {
  const TemporaryFolder folder;
  const auto file = folder.path / "old.vtu";
  std::ofstream(file) << "old";
  const std::string out = " --out " + file.string();
  for (const std::string& arguments :
       {"--shape cat" + out, "--size 0" + out, "--size 100" + out, "--endo-short -3" + out,
        "--endo-short 40" + out, "--base-z 90" + out, std::string("--size 5"),
        "--out " + (folder.path / "mesh.stl").string(),
        "--out " + (folder.path / "none" / "x.vtu").string()}) {
    const auto run = run_program("mesh ellipsoid " + arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_THAT(run.err, HasSubstr("error")) << arguments;
  }
  EXPECT_EQ(whole_file(file), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 1);
}

}  // namespace
