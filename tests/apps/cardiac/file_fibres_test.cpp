#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <polyaffine/vtk/read.hpp>
#include <polyaffine/vtk/write.hpp>
#include <sstream>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using polyaffine::Matrix;
using polyaffine::MeshFile;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kLand = PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu";

/// Numbers of a table; text cells are left out.
std::vector<double> numbers(const fs::path& table) {
  std::istringstream text(whole_file(table));
  std::vector<double> out;
  std::string line, cell;
  std::getline(text, line);
  while (std::getline(text, line))
    for (std::istringstream row(line); std::getline(row, cell, ',');) {
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      if (*end == '\0') out.push_back(value);
    }
  return out;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double out = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) out = std::max(out, std::abs(a[i] - b[i]));
  return out;
}

/// A mesh with the rule's fibres, as `cardiac segment` writes them, and runs on it.
class FileFibres : public testing::Test {
 protected:
  void SetUp() override {
    const ProgramRun run = run_program(
        "segment " + kLand + " --scheme aha17 --length-unit mm --endo-angle 60 --epi-angle -60 --out " +
        in("rule.vtu").string());
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_THAT(run.out, Not(HasSubstr("angle between")));
  }

  fs::path in(const std::string& name) const { return folder_.path / name; }
  MeshFile with_rule() const { return polyaffine::read_mesh_file(in("rule.vtu"), 1, {.fields = true}); }
  void write(const std::string& name, const MeshFile& heart) const {
    polyaffine::write_vtu(in(name), heart.mesh,
                          {.point_fields = heart.point_fields, .cell_fields = heart.cell_fields});
  }

  /// A passive inflation with Guccione's law: stiffer along the fibre. In fewer steps some are halved, and
  /// tables have other rows.
  ProgramRun run(const std::string& mesh, const std::string& fibres, const std::string& options = "") const {
    std::ofstream(in("heart.toml")) << "[mesh]\nfile = \"" << mesh << "\"\nlength_unit = \"mm\"\n"
                                    << "[tissue]\nlaw = \"guccione\"\nbfs = 4\n[fibres]\n"
                                    << fibres
                                    << "\n[cavities]\npressure_mmHg = 7.5\n[time]\nload_steps = 5\n"
                                       "[output]\nfigures = false\nmesh_series = false\n";
    return run_program("run " + in("heart.toml").string() + " --out " + in("out").string() + ' ' + options);
  }
  std::vector<double> strain(const std::string& mesh, const std::string& fibres,
                             const std::string& options = "") const {
    const ProgramRun done = run(mesh, fibres, options);
    EXPECT_EQ(done.status, 0) << done.err;
    return numbers(in("out/strain.csv"));
  }

  TemporaryFolder folder_;
};

TEST_F(FileFibres, TheRulesFibresByWayOfAFileGiveTheSameStrains) {
  const ProgramRun imported = run_program("mesh import " + in("rule.vtu").string() +
                                          " --length-unit mm --out " + in("imported.vtu").string());
  ASSERT_EQ(imported.status, 0) << imported.err;
  for (const std::string method : {"polyaffine", "fem"}) {
    const auto rule = strain(kLand, "endo_angle_deg = 60\nepi_angle_deg = -60", "--method " + method);
    const auto file = strain("imported.vtu", "source = \"file\"", "--method " + method);
    const auto other = strain(kLand, "endo_angle_deg = 30\nepi_angle_deg = -30", "--method " + method);
    // Strains reach 0.19; one vector a tet tells the turning fibres of a wall two tets thick to 0.0015.
    EXPECT_LT(largest_difference(rule, file), 0.002) << method;
    EXPECT_GT(largest_difference(rule, other), 0.02) << method << ": fibres matter";
  }
}

TEST_F(FileFibres, SignsLengthsAndNamesDoNotCount) {
  MeshFile heart = with_rule();
  write("a.vtu", heart);
  const auto expected = strain("a.vtu", "source = \"file\"");
  for (const char* name : {"fibre", "sheet"}) {
    Matrix& field = heart.cell_fields[name];
    for (Eigen::Index t = 0; t < field.cols(); ++t) field.col(t) *= t % 3 == 0 ? -3.0 : 0.2;
    heart.cell_fields[std::string("measured ") + name] = field;
    field.setRandom();
  }
  heart.point_fields.erase("fibre");
  write("b.vtu", heart);
  const auto found = strain(
      "b.vtu", "source = \"file\"\nfibre_array = \"measured fibre\"\nsheet_array = \"measured sheet\"");
  EXPECT_LT(largest_difference(expected, found), 1e-8);
}

TEST_F(FileFibres, ThePlanSaysWhichFibresAreUsed) {
  const ProgramRun file = run("rule.vtu", "source = \"file\"", "--dry-run");
  EXPECT_THAT(file.out, HasSubstr("rule.vtu (fibres.source = file)"));
  const ProgramRun rule = run("rule.vtu", "", "--dry-run");
  EXPECT_THAT(rule.out, HasSubstr("by the rule helix (fibres.source = rule)"));
  EXPECT_THAT(rule.err, HasSubstr("its fibres are not used: fibres.source is rule"));
  EXPECT_THAT(run(kLand, "", "--dry-run").err, testing::IsEmpty());
}

TEST_F(FileFibres, FieldsOfPointsThatTurnTooFarAreAWarning) {
  MeshFile heart = with_rule();
  for (const char* name : {"fibre", "sheet", "normal"}) heart.cell_fields.erase(name);
  write("points.vtu", heart);
  EXPECT_THAT(run("points.vtu", "source = \"file\"", "--dry-run").err,
              AllOf(HasSubstr("warning"), HasSubstr("more than 40° apart"), HasSubstr("points.vtu")));
}

TEST_F(FileFibres, WrongFieldsAreNamed) {
  const MeshFile sound = with_rule();
  const auto refused = [&](const std::string& mesh, const std::string& fibres, const auto& message) {
    const ProgramRun done = run(mesh, fibres);
    EXPECT_EQ(done.status, 2) << fibres;
    EXPECT_THAT(done.err, message) << fibres;
    EXPECT_FALSE(fs::exists(in("out/summary.json"))) << fibres;
  };
  const std::string file = "source = \"file\"\n";
  refused(kLand, file, AllOf(HasSubstr("land_ellipsoid_coarse.vtu"), HasSubstr("found no fibres")));
  refused("rule.vtu", file + "fibre_array = \"fib\"",
          AllOf(HasSubstr("rule.vtu: array \"fib\""), HasSubstr("no point or cell array")));
  refused("rule.vtu", file + "sheet_array = \"segment\"",
          AllOf(HasSubstr("array \"segment\""), HasSubstr("found 1 component"), HasSubstr("3 components")));

  MeshFile zero = sound;
  zero.cell_fields["fibre"].col(41).setZero();
  write("zero.vtu", zero);
  refused("zero.vtu", file,
          AllOf(HasSubstr("zero.vtu"), HasSubstr("\"fibre\""), HasSubstr("tet 41"), HasSubstr("length 0")));
  MeshFile along = sound;
  along.cell_fields["sheet"].col(7) = along.cell_fields["fibre"].col(7);
  write("along.vtu", along);
  refused("along.vtu", file, AllOf(HasSubstr("along.vtu"), HasSubstr("\"sheet\""), HasSubstr("tet 7")));
  MeshFile nan = sound;
  nan.cell_fields["fibre"](1, 3) = NAN;
  write("nan.vtu", nan);
  refused("nan.vtu", file, AllOf(HasSubstr("nan.vtu"), HasSubstr("\"fibre\""), HasSubstr("finite")));
  MeshFile flat = sound;
  flat.point_fields.erase("fibre");
  flat.cell_fields["fibre"] = Matrix(sound.cell_fields.at("fibre").topRows(2));
  write("flat.vtu", flat);
  refused("flat.vtu", file, HasSubstr("\"fibre\" (2 components of tets)"));
  std::string text = whole_file(in("heart.toml"));
  text.replace(text.find("file = "), text.find("[tissue]") - text.find("file = "), "shape = \"human_lv\"\n");
  std::ofstream(in("shape.toml")) << text;
  const ProgramRun shape = run_program("run " + in("shape.toml").string());
  EXPECT_EQ(shape.status, 2);
  EXPECT_THAT(shape.err, AllOf(HasSubstr("fibres.source"), HasSubstr("mesh.shape")));
}

TEST_F(FileFibres, SegmentTellsTheAngleToTheRule) {
  const std::string options = " --scheme aha17 --length-unit mm --out " + in("again.vtu").string();
  const ProgramRun same = run_program("segment " + in("rule.vtu").string() + options);
  ASSERT_EQ(same.status, 0) << same.err;
  EXPECT_THAT(same.out, AllOf(HasSubstr("fibre of tets, sheet of tets"), HasSubstr("median")));
  // Both angles 15° smaller: so are all between.
  const ProgramRun turned =
      run_program("segment " + in("rule.vtu").string() + options + " --endo-angle 45 --epi-angle -75");
  const auto row = turned.out.find("wall    ", turned.out.find("angle between"));
  ASSERT_NE(row, std::string::npos) << turned.out;
  std::istringstream numbers(turned.out.substr(row + 5));
  double volume = 0, mean = 0, median = 0, most = 0;
  numbers >> volume >> mean >> median >> most;
  EXPECT_NEAR(volume, with_rule().mesh.volume() / 1000, 0.05);
  for (const double angle : {mean, median, most}) EXPECT_NEAR(angle, 15, 0.051) << "told to 0.1";
  const MeshFile again = polyaffine::read_mesh_file(in("again.vtu"), 1, {.fields = true});
  EXPECT_NEAR(again.cell_fields.at("fibre_angle_deg").mean(), 15, 1e-6);
  EXPECT_EQ(again.cell_fields.at("file_fibre").cols(), again.mesh.num_tets());
}

}  // namespace
