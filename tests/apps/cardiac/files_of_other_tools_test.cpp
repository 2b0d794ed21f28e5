#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <polyaffine/vtk/read.hpp>

#include "program.hpp"
#include "raw_mesh.hpp"
#include "support/hearts_of_other_tools.hpp"
#include "support/vtk_writers.hpp"

namespace {

namespace fs = std::filesystem;
using polyaffine::MeshData;
using polyaffine::TetMesh;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using namespace testing_io;

/// A file that another tool could have written, and what becomes of it. Options may name the folder {}.
struct OtherFile {
  std::string name, file;
  std::function<void(const fs::path&)> make;
  std::string options = "";
  int status = 0;
  std::vector<std::string> words = {};  ///< of the report, or of the message when it is refused
  double tolerance = 1e-6;              ///< of areas and volumes against the heart it was made of, relative
};

constexpr double kFilled = 0.022;   // a surface filled anew with edges of 7 mm; 0.011 is reached
constexpr double kOfPoints = 1e-6;  // the borders lie on the rims
const std::string kFill = "--size 7 ";

auto gmsh(const MeshData& mesh, double version, bool binary) {
  return [=](const fs::path& file) {
    version < 4 ? write_gmsh_2(file, mesh, binary) : write_gmsh_4(file, mesh, binary);
  };
}

auto xml(const MeshData& mesh, bool polydata = false) {
  return [=](const fs::path& file) { write_vtk_xml(file, mesh, polydata); };
}

MeshData changed(MeshData mesh, const std::function<void(MeshData&)>& change) {
  change(mesh);
  return mesh;
}

MeshData without_labels(MeshData mesh) {
  mesh.triangles.resize(3, 0);
  mesh.triangle_fields.clear();
  return mesh;
}

/// A mesh without labels and a file for each surface beside it.
std::function<void(const fs::path&)> with_surfaces(const std::string& endo, const std::string& epi,
                                                   const std::string& base) {
  return [=](const fs::path& file) {
    write_vtk_xml(file, without_labels(ventricle_data()), false);
    for (const auto& [label, name] : {std::pair{1, endo}, {2, epi}, {3, base}}) {
      const fs::path at = file.parent_path() / name;
      if (name.ends_with(".vtp")) write_vtk_xml(at, surface_alone(label), true);
      if (name.ends_with(".stl")) write_stl(at, surface_alone(label), true);
      if (name.ends_with(".obj")) write_obj(at, surface_alone(label));
    }
  };
}

void write_capitals(const fs::path& file, const MeshData& mesh) {
  const fs::path small = fs::path(file).replace_extension(".pts");
  write_opencarp(small, mesh);
  for (const auto& [from, to] : {std::pair{".pts", ".PTS"}, {".elem", ".ELEM"}})
    fs::rename(fs::path(small).replace_extension(from), fs::path(small).replace_extension(to));
}

std::vector<OtherFile> tetrahedra() {
  const MeshData plain = ventricle_data();
  const MeshData blood = with_blood();
  const MeshData carp = changed(without_labels(with_blood()), [](MeshData& m) {
    m.tet_fields["region"] = m.tet_fields["region"].array() * 10;
  });
  const MeshData material = changed(without_labels(with_blood()), [](MeshData& m) {
    m.tet_fields["Kind"] = m.tet_fields["region"];
    m.tet_fields.erase("region");
  });
  const MeshData not_a_number = changed(plain, [](MeshData& m) {
    m.triangle_fields["surface"] = m.triangle_fields["physical"];
    m.triangle_fields.erase("physical");
    const Eigen::Index n = m.triangles.cols();
    m.triangles.conservativeResize(3, n + 1);
    m.triangles.col(n) = m.tets.col(0).head(3);
    m.triangle_fields["surface"].conservativeResize(1, n + 1);
    m.triangle_fields["surface"](0, n) = std::numeric_limits<double>::quiet_NaN();
  });
  return {
      {"legacy_vtk_text", "heart.vtk", [=](const fs::path& f) { write_legacy_vtk(f, plain); }},
      {"legacy_vtk_binary", "heart.vtk", [=](const fs::path& f) { write_legacy_vtk_binary(f, plain); }},
      {"meshio_with_int32", "heart.vtk", [=](const fs::path& f) { write_meshio_vtk(f, plain); }},
      {"gmsh_2_in_capitals", "HEART.MSH", gmsh(plain, 2.2, false)},
      {"xml_in_capitals", "HEART.VTU", xml(plain)},
      {"opencarp_in_capitals", "HEART.PTS", [=](const fs::path& f) { write_capitals(f, plain); }},
      {"caps_with_a_centre",
       "heart.vtu",
       xml(with_cap(true)),
       "--label-array physical --endo-label 1 --epi-label 2 --base-label 3",
       0,
       {"16 triangles with label 5 left out"}},
      {"caps_without_a_centre",
       "heart.vtu",
       xml(with_cap(false)),
       "--label-array physical --endo-label 1 --epi-label 2 --base-label 3",
       0,
       {"14 triangles with label 5 left out"}},
      {"endocardium_twice",
       "heart.vtu",
       xml(with_repetition()),
       "--label-array physical --endo-label 1 --epi-label 2 --base-label 3",
       0,
       {"triangles with label 6 left out"}},
      {"labels_not_a_number",
       "heart.vtu",
       xml(not_a_number),
       "",
       0,
       {"1 triangles whose label is not a number"}},
      {"two_labels_for_a_triangle",
       "heart.msh",
       gmsh(changed(plain,
                    [](MeshData& m) {
                      add_triangle(m, m.triangles.col(0), m.triangle_fields["physical"](0, 0) == 1 ? 2 : 1);
                    }),
            2.2, false),
       "",
       0,
       {"1 triangles are listed with two labels"}},
      {"labels_of_points",
       "heart.vtu",
       xml(changed(with_labels_of_points(), [](MeshData& m) { m.triangles.resize(3, 0); })),
       "--label-array class --base-label 1 --epi-label 2 --endo-label 3",
       0,
       {"triangles labelled by the point array \"class\"", "by all three corners"},
       kOfPoints},
      {"labels_of_cobiveco",
       "heart.vtu",
       xml(with_labels_of_points()),
       "",
       0,
       {"Cobiveco", "1 base, 2 epi, 3 lv, 4 rv"},
       kOfPoints},
      {"point_array_not_named",
       "heart.vtu",
       xml(changed(with_labels_of_points(),
                   [](MeshData& m) {
                     m.point_fields["wall"] = m.point_fields["class"];
                     m.point_fields.erase("class");
                   })),
       "",
       0,
       {"point array \"wall\"", "not used"}},
      {"blood_without_a_choice",
       "heart.msh",
       gmsh(blood, 2.2, false),
       "",
       2,
       {"endocardium", "between two tets", "1 \"myocardium\" (", "2 \"blood\" (", "--region"}},
      {"blood_left_out_by_name",
       "heart.msh",
       gmsh(blood, 2.2, true),
       "--region myocardium",
       0,
       {"region 1 \"myocardium\" (", "kept", "2 \"blood\" ("}},
      {"blood_left_out_by_number", "heart.msh", gmsh(blood, 4.1, true), "--region 1", 0, {"2 \"blood\" ("}},
      {"region_not_there",
       "heart.msh",
       gmsh(blood, 4.1, false),
       "--region wall",
       2,
       {"\"wall\"", "1 \"myocardium\" (", "2 \"blood\" ("}},
      {"opencarp_with_tags",
       "heart.pts",
       [=](const fs::path& f) { write_opencarp(f, carp); },
       "--region 10",
       0,
       {"region 10 (", "recognised from the shape"}},
      {"opencarp_without_a_choice",
       "heart.pts",
       [=](const fs::path& f) { write_opencarp(f, carp); },
       "",
       2,
       {"no cavity", "10 (", "20 ("}},
      {"material_array", "heart.vtu", xml(material), "--region 1 --region-array Kind", 0, {"region 1 ("}},
      {"region_array_not_named", "heart.vtu", xml(material), "--region 1", 2, {"\"Kind\"", "region_array"}},
      {"files_of_svfsi", "mesh.vtu", with_surfaces("endo.vtp", "epi.vtp", "base.vtp"),
       "--surface-file endo={}/endo.vtp --surface-file epi={}/epi.vtp --surface-file base={}/base.vtp"},
      {"files_by_their_names",
       "mesh.vtu",
       with_surfaces("lv.obj", "epi.obj", "base.obj"),
       "--surface-file {}/lv.obj --surface-file {}/epi.obj --surface-file {}/base.obj",
       0,
       {"lv.obj is the endocardium by its name"},
       1e-6},
      {"files_without_a_base",
       "mesh.vtu",
       with_surfaces("endo.stl", "epi.stl", "none"),
       "--surface-file endo={}/endo.stl --surface-file epi={}/epi.stl",
       0,
       {"the rest of the boundary is base"}},
      {"one_file_of_three",
       "mesh.vtu",
       with_surfaces("endo.vtp", "epi.vtp", "base.vtp"),
       "--surface-file {}/endo.vtp",
       2,
       {"no file of the surface \"epi\"", "NAME=FILE"}},
      {"files_without_a_name",
       "mesh.vtu",
       with_surfaces("a.vtp", "b.vtp", "c.vtp"),
       "--surface-file {}/a.vtp --surface-file {}/b.vtp",
       2,
       {"a.vtp", "NAME=FILE"}},
      {"an_empty_file", "heart.vtk", [](const fs::path& f) { std::ofstream{f}; }, "", 2, {"heart.vtk"}},
      {"hexahedra",
       "heart.vtu",
       [](const fs::path& f) {
         RawMesh mesh = raw(ventricle());
         mesh.cells.push_back({kVtkHexahedron, {0, 1, 2, 3, 4, 5, 6, 7}, 0});
         write_raw(f, mesh);
       },
       "",
       2,
       {"hexahedron"}},
  };
}

std::vector<OtherFile> surfaces() {
  const MeshData plain = ventricle_data();
  const MeshData lid = changed(with_cap(true), [](MeshData& m) { m.tets.resize(4, 0); });
  return {
      {"stl_in_capitals",
       "WALL.STL",
       [=](const fs::path& f) { write_stl(f, plain, false); },
       kFill,
       0,
       {},
       kFilled},
      {"ply_with_labels",
       "wall.ply",
       [=](const fs::path& f) { write_ply(f, plain, true); },
       kFill,
       0,
       {"labels \"label\" of the surface carried over"},
       kFilled},
      {"vtk_polydata",
       "wall.vtk",
       [=](const fs::path& f) { write_vtk_polydata(f, plain); },
       kFill,
       0,
       {"closed surface of"},
       kFilled},
      {"polydata_with_a_cap",
       "wall.vtp",
       xml(lid, true),
       kFill + "--label-array physical --endo-label 1 --epi-label 2 --base-label 3",
       0,
       {"16 triangles with label 5 left out"},
       kFilled},
      {"polydata_with_labels_of_points",
       "wall.vtp",
       xml(with_labels_of_points(), true),
       kFill + "--label-array class --base-label 1 --epi-label 2 --endo-label 3",
       0,
       {"by the point array"},
       kFilled},
      {"polydata_without_a_label",
       "wall.vtp",
       xml(with_labels_of_points(), true),
       kFill + "--label-array part",
       2,
       {"\"part\"", "point arrays: \"class\""}},
      {"polydata_with_swapped_labels",
       "wall.vtp",
       xml(with_labels_of_points(), true),
       "--size 1 --label-array class --base-label 1 --epi-label 3 --endo-label 2",
       2,
       {"swapped"}},
      {"obj_with_a_hole",
       "wall.obj",
       [=](const fs::path& f) {
         write_obj(f, changed(plain, [](MeshData& m) {
                     m.triangles.conservativeResize(3, m.triangles.cols() - 1);
                   }));
       },
       kFill,
       2,
       {"3 edges of one triangle"}},
  };
}

class FilesOfOtherTools : public testing::TestWithParam<OtherFile> {
 protected:
  /// The options with the folder in the place of {}.
  std::string options() const {
    std::string text = GetParam().options;
    for (std::size_t at = text.find("{}"); at != std::string::npos; at = text.find("{}"))
      text.replace(at, 2, folder_.path.string());
    return text;
  }

  void expect_the_ventricle(const TetMesh& mesh) const {
    const double most = GetParam().tolerance;
    EXPECT_NEAR(mesh.volume(), ventricle().volume(), std::min(most, kFilled) * ventricle().volume());
    for (const int label : {1, 2, 3}) {
      const double area = polyaffine::surface_area(ventricle(), {label});
      EXPECT_NEAR(polyaffine::surface_area(mesh, {label}), area, most * area) << "label " << label;
    }
  }

  TemporaryFolder folder_;
};

TEST_P(FilesOfOtherTools, ComeToABeatOrToAReason) {
  const OtherFile& given = GetParam();
  const fs::path file = folder_.path / given.file, out = folder_.path / "out.vtu";
  given.make(file);
  const ProgramRun run = run_program("mesh import " + file.string() + " --length-unit mm --out " +
                                     out.string() + ' ' + options());
  if (run.err.find("POLYAFFINE_WITH_CGAL") != std::string::npos) GTEST_SKIP() << run.err;
  ASSERT_EQ(run.status, given.status) << run.err << run.out;
  const std::string& said = given.status == 0 ? run.out : run.err;
  for (const std::string& word : given.words) EXPECT_THAT(said, HasSubstr(word));
  if (given.status != 0) {
    EXPECT_THAT(run.err, StartsWith("cardiac: error: "));
    const std::string path = file.string();
    EXPECT_EQ(run.err.find(path, run.err.find(path) + 1), std::string::npos) << "named twice: " << run.err;
    EXPECT_FALSE(fs::exists(out));
    return;
  }
  expect_the_ventricle(polyaffine::read_vtu(out, 1));
  const ProgramRun plan =
      run_program("run " PROJECT_DIR "/protocols/healthy_lv.toml --dry-run --set mesh.file=" + out.string());
  EXPECT_EQ(plan.status, 0) << plan.err;
  EXPECT_THAT(plan.out, Not(IsEmpty()));
}

TEST(FilesInAProtocol, RegionsAndFilesOfOneSurfaceEach) {
  const TemporaryFolder folder;
  const fs::path& at = folder.path;
  write_gmsh_2(at / "blood.msh", with_blood(), false);
  with_surfaces("endo.vtp", "epi.vtp", "base.vtp")(at / "mesh.vtu");
  const auto plan = [&](const std::string& settings) {
    return run_program("run " PROJECT_DIR "/protocols/healthy_lv.toml --dry-run --set mesh.file=" +
                       (at / settings).string());
  };
  const ProgramRun blood = plan("blood.msh --set mesh.region=myocardium");
  EXPECT_EQ(blood.status, 0) << blood.err;
  EXPECT_THAT(blood.out + blood.err, HasSubstr("region 1 \"myocardium\""));
  const ProgramRun all = plan("blood.msh");
  EXPECT_EQ(all.status, 2);
  EXPECT_THAT(all.err, HasSubstr("mesh.region"));
  const std::string surfaces = "mesh.vtu --set 'mesh.surface_files=[\"endo=" + (at / "endo.vtp").string() +
                               "\", \"epi=" + (at / "epi.vtp").string() + "\"]'";
  const ProgramRun two = plan(surfaces);
  EXPECT_EQ(two.status, 0) << two.err;
  EXPECT_THAT(two.out + two.err, HasSubstr("the rest of the boundary is base"));
  const ProgramRun both = plan(surfaces + " --set mesh.surface_file=" + (at / "endo.vtp").string());
  EXPECT_EQ(both.status, 2);
  EXPECT_THAT(both.err, HasSubstr("mesh.surface_files"));
}

const auto name_of = [](const auto& file) { return file.param.name; };
INSTANTIATE_TEST_SUITE_P(Tetrahedra, FilesOfOtherTools, testing::ValuesIn(tetrahedra()), name_of);
INSTANTIATE_TEST_SUITE_P(Surfaces, FilesOfOtherTools, testing::ValuesIn(surfaces()), name_of);

}  // namespace
