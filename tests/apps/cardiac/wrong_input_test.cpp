#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "program.hpp"
#include "raw_mesh.hpp"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// Name and content of every file in a folder.
std::map<std::string, std::string> content(const fs::path& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    out[entry.path().string()] = entry.is_regular_file() ? whole_file(entry.path()) : "folder";
  return out;
}

/// The results of an earlier run.
fs::path earlier_results(const fs::path& in) {
  fs::path out = in / "results";
  fs::create_directory(out);
  for (const char* name : {"summary.json", "strain.csv", "heart_0000.vtu", "heart_0123.vtu", "heart.pvd",
                           "report.html", "pv_loop.svg", "note.txt"})
    std::ofstream(out / name) << "earlier " << name;
  return out;
}

std::string protocol_text(const std::string& mesh) {
  return "[mesh]\n" + mesh + "\n[tissue]\nlaw = \"neo_hookean\"\n[cavities]\npressure_mmHg = 1\n";
}

/// Something wrong, put into a folder, and what the message must say.
struct WrongInput {
  std::string name;
  std::function<std::string(const fs::path&)> arguments;  ///< of `cardiac run`, after what is wrong is made
  std::vector<std::string> message;
};

/// A protocol on a sound mesh, with options.
WrongInput with_options(const std::string& name, const std::string& options,
                        const std::vector<std::string>& message) {
  return {name,
          [=](const fs::path& folder) {
            std::ofstream(folder / "sound.toml") << protocol_text(
                "file = \"" PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu\"\nlength_unit = \"mm\"");
            return (folder / "sound.toml").string() + ' ' + options;
          },
          message};
}

WrongInput with_mesh_table(const std::string& name, const std::string& table,
                           std::vector<std::string> message) {
  return {name,
          [=](const fs::path& folder) {
            std::ofstream(folder / "wrong.toml") << protocol_text(table);
            return (folder / "wrong.toml").string();
          },
          std::move(message)};
}

/// A sound protocol whose mesh is damaged; the message names the mesh.
WrongInput with_mesh(const std::string& name, const std::function<void(RawMesh&)>& damage,
                     std::vector<std::string> message) {
  message.emplace_back("heart.vtu:");
  return {name,
          [=](const fs::path& folder) {
            RawMesh mesh = raw(land_mesh());
            damage(mesh);
            write_raw(folder / "heart.vtu", mesh);
            std::ofstream(folder / "heart.toml")
                << protocol_text("file = \"heart.vtu\"\nlength_unit = \"mm\"");
            return (folder / "heart.toml").string();
          },
          message};
}

std::vector<RawMesh::Cell*> triangles(RawMesh& mesh, int label) {
  std::vector<RawMesh::Cell*> out;
  for (auto& cell : mesh.cells)
    if (cell.vtk_type == kVtkTriangle && cell.label == label) out.push_back(&cell);
  return out;
}

/// Endocardial triangles whose corners are all, or of which at least one is, beyond a height (mm; the base is
/// at 5) become bare.
void uncover(RawMesh& mesh, const std::function<bool(const polyaffine::Vec3&)>& corner) {
  for (auto* t : triangles(mesh, 1))
    if (std::ranges::any_of(t->points, [&](int p) { return corner(mesh.points[p]); })) t->label = 0;
}

void add_isolated_tet(RawMesh& mesh) {
  const int first = static_cast<int>(mesh.points.size());
  for (const polyaffine::Vec3& x :
       std::vector<polyaffine::Vec3>{{50, 0, 0}, {51, 0, 0}, {50, 1, 0}, {50, 0, 1}})
    mesh.points.push_back(x);
  mesh.cells.push_back({kVtkTetra, {first, first + 1, first + 2, first + 3}, 0});
}

void add_hexahedron(RawMesh& mesh) {
  mesh.cells.push_back({kVtkHexahedron, {0, 1, 2, 3, 4, 5, 6, 7}, 0});
}

std::vector<WrongInput> protocol_cases() {
  const std::string land = "file = \"" PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu\"";
  return {
      {"missing_protocol",
       [](const fs::path& f) { return (f / "none.toml").string(); },
       {"none.toml", "no such file", "expected a protocol (.toml)"}},
      {"wrong_extension_of_protocol",
       [](const fs::path& f) {
         std::ofstream(f / "heart.yaml") << "mesh: heart\n";
         return (f / "heart.yaml").string();
       },
       {"heart.yaml", "found the extension \".yaml\"", ".toml"}},
      {"folder_as_protocol", [](const fs::path& f) { return f.string(); }, {"expected a protocol (.toml)"}},
      with_mesh_table("missing_mesh_file", "file = \"none.vtu\"\nlength_unit = \"mm\"",
                      {"mesh.file", "none.vtu", "no such file", "expected"}),
      with_mesh_table("wrong_extension_of_mesh", "file = \"heart.stl\"\nlength_unit = \"mm\"",
                      {"mesh.file", "wrong.toml:2", "found \"heart.stl\"", "expected", ".vtu"}),
      with_mesh_table("missing_length_unit", land,
                      {"wrong.toml", "mesh.length_unit", "missing", "\"mm\", \"cm\", \"m\""}),
      with_mesh_table(
          "unknown_length_unit", land + "\nlength_unit = \"inch\"",
          {"wrong.toml:3", "mesh.length_unit", "found the text \"inch\"", "\"mm\", \"cm\", \"m\""}),
      with_mesh_table("unknown_key", land + "\nlength_unit = \"mm\"\nendo_labell = 1",
                      {"wrong.toml:4", "mesh.endo_labell", "unknown key", "mesh.endo_label"}),
      with_mesh_table("no_toml", "file = = 3", {"wrong.toml:2", "not valid TOML"}),
      with_options("unknown_table", "--set tisue.mu_kPa=1", {"tisue", "nearest known table is tissue"}),
      with_options("key_without_unit", "--set tissue.mu=3",
                   {"tissue.mu", "tissue.mu_kPa", "the unit is part of the name"}),
      with_options("wrong_type", "--set tissue.mu_kPa=soft",
                   {"tissue.mu_kPa", "found the text \"soft\"", "expected a number in kPa"}),
      with_options("fraction_for_a_whole_number", "--set time.max_beats=2.5",
                   {"time.max_beats", "found the number 2.5", "a whole number"}),
      with_options("negative_stiffness", "--set tissue.mu_kPa=-1",
                   {"tissue.mu_kPa", "found the number -1", "above 0", "kPa"}),
      with_options("stiffness_not_a_number", "--set tissue.mu_kPa=nan", {"tissue.mu_kPa", "kPa"}),
      with_options("override_without_value", "--set tissue.mu_kPa",
                   {"tissue.mu_kPa", "expected key.path=value"}),
      with_options("override_without_key", "--set =3", {"expected key.path=value"}),
      with_options("override_of_nonsense", "--set '?!'", {"--set ?!", "expected key.path=value"}),
      with_options("parallel_directions", "--set anatomy.anterior_direction='[0, 0, 1]'",
                   {"anatomy.anterior_direction", "found (0, 0, 1)", "parallel", "expected"}),
      with_options("swapped_labels", "--set mesh.epi_label=1 --set mesh.endo_label=2",
                   {"land_ellipsoid_coarse.vtu", "endocardium", "surrounds no cavity", "swapped"}),
      with_mesh_table("missing_surface_file", land + "\nlength_unit = \"mm\"\nsurface_file = \"none.vtp\"",
                      {"mesh.surface_file", "none.vtp", "no such file"}),
      with_options("labels_not_in_the_mesh", "--set mesh.epi_label=8",
                   {"land_ellipsoid_coarse.vtu", "label 8", "labels found: 1, 2, 3", "epi_label"}),
      with_options("label_array_not_in_the_mesh", "--set mesh.label_array=faces",
                   {"land_ellipsoid_coarse.vtu", "\"surface\"", "expected", "\"faces\""}),
      with_options("no_site_on_the_endocardium",
                   "--set contraction.contractility_kPa=50 --set fibres.endo_angle_deg=60 "
                   "--set activation.mode=sites --set 'activation.site_segments=[17]'",
                   {"activation.site_segments", "segment 17", "expected"}),
  };
}

std::vector<WrongInput> mesh_cases() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {
      {"garbage_mesh",
       [](const fs::path& f) {
         std::ofstream(f / "heart.vtu") << "<VTKFile type=\"Unstruct\x01\x02 no mesh at all";
         std::ofstream(f / "heart.toml") << protocol_text("file = \"heart.vtu\"\nlength_unit = \"mm\"");
         return (f / "heart.toml").string();
       },
       {"heart.vtu:", "found the end of the file", "expected"}},
      {"cut_off_mesh",
       [](const fs::path& f) {
         const std::string whole = whole_file(PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu");
         std::ofstream(f / "heart.vtu") << whole.substr(0, whole.size() / 2);
         std::ofstream(f / "heart.toml") << protocol_text("file = \"heart.vtu\"\nlength_unit = \"mm\"");
         return (f / "heart.toml").string();
       },
       {"heart.vtu:", "cut off", "expected"}},
      with_mesh("inverted_tet",
                [](RawMesh& m) {  // its first vertex beyond the opposite face
                  const auto& t = m.cells[7].points;
                  m.points[t[0]] +=
                      1.5 * ((m.points[t[1]] + m.points[t[2]] + m.points[t[3]]) / 3 - m.points[t[0]]);
                },
                {"near (", "mm", "is inverted", "expected tets that do not overlap"}),
      with_mesh("isolated_tets", add_isolated_tet,
                {"tet 1784", "is isolated", "found 1 tets", "expected one"}),
      with_mesh("flat_tet",
                [](RawMesh& m) {
                  const auto& t = m.cells[0].points;
                  m.points[t[0]] = (m.points[t[1]] + m.points[t[2]] + m.points[t[3]]) / 3;
                },
                {"is flat", "found volume", "mm³", "expected a positive volume"}),
      with_mesh("missing_surface_label",
                [](RawMesh& m) {
                  for (auto* t : triangles(m, 3)) t->label = 9;
                },
                {"label 3", "\"base\"", "labels found: 1, 2, 9", "base_label"}),
      with_mesh("hole_in_the_endocardium", [](RawMesh& m) { triangles(m, 1).front()->label = 0; },
                {"open cavity", "found", "rim", "off the base", "expected"}),
      with_mesh("endocardium_that_does_not_reach_the_base",
                [](RawMesh& m) { uncover(m, [](const auto& x) { return x.z() > 4.9; }); },
                {"open cavity", "off the base", "mm", "expected the endocardium to reach the base"}),
      with_mesh("gap_at_the_base",
                [](RawMesh& m) { uncover(m, [](const auto& x) { return x.z() > 4.9 && x.x() > 5; }); },
                {"open cavity", "off the base", "mm", "expected"}),
      with_mesh("closed_endocardium",
                [](RawMesh& m) {
                  for (const int label : {2, 3})
                    for (auto* t : triangles(m, label)) t->label = 1;
                },
                {"\"epi\"", "labels found: 1", "expected"}),
      with_mesh("segment_without_a_tet", [](RawMesh& m) { m = nine_tets(); },
                {"AHA segment", "size zero", "finer mesh"}),
      with_mesh("coordinate_not_a_number", [=](RawMesh& m) { m.points[5].y() = nan; },
                {"point 5", "not a number", "expected finite"}),
      with_mesh("hexahedra", add_hexahedron, {"cell", "hexahedron", "expected 10 (tetrahedron)"}),
      with_mesh("label_off_the_boundary",
                [](RawMesh& m) {
                  const auto& t = m.cells[0].points;
                  m.cells.push_back({kVtkTriangle, {t[0], t[1], m.cells.at(900).points[2]}, 1});
                },
                {"labelled triangle", "label 1", "boundary"}),
  };
}

class WrongInputTest : public testing::TestWithParam<WrongInput> {
 protected:
  TemporaryFolder folder_;
};

TEST_P(WrongInputTest, IsStatusTwoWithAClearMessageAndDamagesNothing) {
  const fs::path out = earlier_results(folder_.path);
  const std::string arguments = GetParam().arguments(folder_.path);
  const auto before = content(folder_.path);
  for (const char* dry : {"", " --dry-run"}) {
    if (*dry && GetParam().name == "no_site_on_the_endocardium") continue;  // found when the sites are built
    const auto run = run_program("run " + arguments + " --out " + out.string() + dry);
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.out, IsEmpty());
    EXPECT_THAT(run.err, StartsWith("cardiac: error: "));
    for (const std::string& part : GetParam().message) EXPECT_THAT(run.err, HasSubstr(part));
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << "one message: " << run.err;
    EXPECT_EQ(content(folder_.path), before);
  }
}

std::string name_of(const testing::TestParamInfo<WrongInput>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Protocol, WrongInputTest, testing::ValuesIn(protocol_cases()), name_of);
INSTANTIATE_TEST_SUITE_P(Mesh, WrongInputTest, testing::ValuesIn(mesh_cases()), name_of);

class WrongOutTest : public testing::Test {
 protected:
  void expect_refusal(const std::string& out, const std::string& reason,
                      const std::string& before = "") const {
    const std::string sound = with_options("", "", {}).arguments(folder_.path);
    const auto run = run_program("run " + sound + " --out " + out, before);
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.out, IsEmpty());
    EXPECT_THAT(run.err, testing::AllOf(HasSubstr(out), HasSubstr(reason)));
  }
  TemporaryFolder folder_;
};

TEST_F(WrongOutTest, FileInsteadOfAFolder) {
  std::ofstream(folder_.path / "file") << "kept";
  expect_refusal((folder_.path / "file").string(), "cannot make the folder");
  EXPECT_EQ(whole_file(folder_.path / "file"), "kept");
}

TEST_F(WrongOutTest, FolderThatCannotBeMade) {
  expect_refusal("/proc/cardiac_results", "cannot make the folder");
}

TEST_F(WrongOutTest, FolderThatCannotBeWrittenInto) {
  const fs::path locked = folder_.path / "locked";
  fs::create_directory(locked);
  fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec);
  // Root may write anywhere; without its capabilities it is as any other user.
  std::string as_a_user;
  if (::geteuid() == 0) {
    as_a_user = "setpriv --bounding-set=-all --inh-caps=-all ";
    if (std::system((as_a_user + "true").c_str()) != 0) GTEST_SKIP() << "root keeps its capabilities here";
  }
  expect_refusal(locked.string(), "cannot write into the folder", as_a_user);
  fs::permissions(locked, fs::perms::owner_all);
}

// A result of an earlier run as the mesh of the next one, in the same folder.
TEST_F(WrongOutTest, FolderOfTheMeshThatWouldBeRemoved) {
  const fs::path mesh = folder_.path / "heart_0000.vtu";
  fs::copy_file(PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu", mesh);
  const std::string sound = with_options("", "", {}).arguments(folder_.path);
  const auto run = run_program("run " + sound + " --set 'mesh.file=\"" + mesh.string() + "\"' --out " +
                               folder_.path.string());
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, testing::AllOf(HasSubstr("--out"), HasSubstr(mesh.string())));
  EXPECT_TRUE(fs::exists(mesh));
}

TEST(WrongUsage, RunWithoutAProtocol) {
  for (const char* arguments : {"run", "run --out nowhere", "run --set"}) {
    const auto run = run_program(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_THAT(run.out, IsEmpty());
    EXPECT_THAT(run.err, StartsWith("cardiac: error: "));
  }
  EXPECT_THAT(run_program("run").err, HasSubstr("PROTOCOL"));
}

}  // namespace
