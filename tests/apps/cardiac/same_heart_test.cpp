#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <polyaffine/vtk/read.hpp>
#include <polyaffine/vtk/write.hpp>
#include <sstream>

#include "program.hpp"
#include "support/mesh_writers.hpp"
#include "support/shuffled.hpp"

namespace {

namespace fs = std::filesystem;
using polyaffine::Mat3;
using polyaffine::TetMesh;
using polyaffine::Vec3;

/// A heart inflated, its fibres by the rule: strains of more than ten per cent.
class SameHeart : public testing::TestWithParam<const char*> {
 protected:
  fs::path in(const std::string& name) const { return folder_.path / name; }

  /// Longitudinal, circumferential and radial strain of each segment at each time.
  std::vector<double> strain(const std::string& mesh, const std::string& unit, const std::string& anatomy) {
    std::ofstream(in("heart.toml"))
        << "[mesh]\nfile = \"" << mesh << "\"\nlength_unit = \"" << unit << "\"\n[anatomy]\n"
        << anatomy << "\n[reduction]\nmethod = \"" << GetParam()
        << "\"\n[tissue]\nlaw = \"guccione\"\n[fibres]\n[cavities]\n"
           "pressure_mmHg = 7.5\n[time]\nload_steps = 2\n[output]\nfigures = false\nmesh_series = false\n";
    const ProgramRun run = run_program("run " + in("heart.toml").string() + " --out " + in("out").string());
    EXPECT_EQ(run.status, 0) << mesh << run.err;
    std::istringstream table(whole_file(in("out/strain.csv")));
    std::vector<double> out;
    std::string line, cell;
    std::getline(table, line);
    while (std::getline(table, line)) {
      std::istringstream row(line);
      for (int k = 0; std::getline(row, cell, ','); ++k)
        if (k >= 3 && k < 6) out.push_back(std::stod(cell));
    }
    return out;
  }

  void expect_same(const std::vector<double>& a, const std::vector<double>& b, const std::string& what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    double difference = 0;
    std::size_t where = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      if (const double d = std::abs(a[i] - b[i]); !(d <= difference)) {
        difference = d;
        where = i;
      }
    RecordProperty(what, std::to_string(difference));
    EXPECT_LT(difference, 1e-3) << what << ", entry " << where << " of " << a.size();
  }

  TemporaryFolder folder_;
};

double largest(const std::vector<double>& values) {
  double out = 0;
  for (const double v : values) out = std::max(out, std::abs(v));
  return out;
}

TEST_P(SameHeart, TurnedShuffledInAnotherUnitAndFormatHasTheSameStrainTable) {
  const std::string file = PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu";
  const std::vector<double> expected = strain(file, "mm", "");
  EXPECT_GT(largest(expected), 0.05);
  const Mat3 turn = a_rotation();
  const TetMesh moved = shuffled(polyaffine::read_vtu(file, 1), turn, Vec3(30, -20, 50));
  polyaffine::MeshData data = testing_io::data_of(moved);
  data.points *= 0.1;
  testing_io::write_gmsh_2(in("text2.msh"), data, false);
  testing_io::write_gmsh_4(in("binary4.msh"), data, true);
  testing_io::write_opencarp(in("carp.pts"), data);
  testing_io::write_legacy_vtk(in("legacy.vtk"), data);
  polyaffine::write_vtu(in("xml.vtu"),
                        TetMesh(data.points, moved.tets(), {}, {moved.boundary(), moved.boundary_labels()}));
  std::ostringstream anterior;
  anterior.precision(17);
  anterior << "anterior_direction = [" << turn(0, 1) << ", " << turn(1, 1) << ", " << turn(2, 1) << ']';
  for (const char* name : {"text2.msh", "binary4.msh", "carp.pts", "legacy.vtk", "xml.vtu"})
    expect_same(strain(name, "cm", anterior.str()), expected, name);
}

TEST_P(SameHeart, OfTwoVentriclesTurnedAndShuffledHasTheSameStrainTable) {
  const std::string file = PROJECT_DIR "/meshes/healthy_biv_coarse.vtu";
  const std::string scheme = "scheme = \"aha29\"";
  const std::vector<double> expected = strain(file, "mm", scheme);
  EXPECT_GT(largest(expected), 0.05);
  const TetMesh moved = shuffled(polyaffine::read_vtu(file, 1), a_rotation(), Vec3(30, -20, 50));
  polyaffine::MeshData data = testing_io::data_of(moved);
  data.points *= 0.001;
  testing_io::write_gmsh_4(in("binary4.msh"), data, true);
  expect_same(strain("binary4.msh", "m", scheme), expected, "biventricle");
}

INSTANTIATE_TEST_SUITE_P(Method, SameHeart, testing::Values("polyaffine", "fem"));

}  // namespace
