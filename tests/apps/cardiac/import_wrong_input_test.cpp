#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "program.hpp"
#include "raw_mesh.hpp"
#include "support/mesh_writers.hpp"

namespace {

namespace fs = std::filesystem;
using polyaffine::MeshData;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// A file that is made in a folder, options, and what the message must say.
struct WrongFile {
  std::string name, file;
  std::function<void(const fs::path&)> make;
  std::vector<std::string> message;
  std::string options = "--length-unit mm";
};

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::function<void(const fs::path&)> text(const std::string& content) {
  return [=](const fs::path& file) { write_text(file, content); };
}

/// The first part of what a writer writes.
template <class Write>
std::function<void(const fs::path&)> cut_off(const Write& write, double part) {
  return [=](const fs::path& file) {
    write(file, testing_io::data_of(land_mesh()));
    fs::resize_file(file, static_cast<std::uintmax_t>(part * static_cast<double>(fs::file_size(file))));
  };
}

/// The Land ellipsoid, damaged, as Gmsh 4.1.
std::function<void(const fs::path&)> damaged(const std::function<void(MeshData&)>& damage) {
  return [=](const fs::path& file) {
    MeshData mesh = testing_io::data_of(land_mesh());
    damage(mesh);
    testing_io::write_gmsh_4(file, mesh, true);
  };
}

/// The boundary of the Land ellipsoid, damaged, as OFF.
std::function<void(const fs::path&)> surface(const std::function<void(MeshData&)>& damage) {
  return [=](const fs::path& file) {
    MeshData mesh = testing_io::data_of(land_mesh());
    damage(mesh);
    testing_io::write_off(file, mesh);
  };
}

std::function<void(MeshData&)> relabelled(std::map<int, int> to) {
  return [=](MeshData& mesh) {
    for (double& label : mesh.triangle_fields["physical"].reshaped()) label = to.at(static_cast<int>(label));
  };
}

void add_second_body(MeshData& mesh) {
  const auto points = static_cast<int>(mesh.points.cols());
  const Eigen::Index tets = mesh.tets.cols(), triangles = mesh.triangles.cols();
  mesh.points.conservativeResize(3, 2 * points);
  mesh.points.rightCols(points) = mesh.points.leftCols(points).colwise() + polyaffine::Vec3(50, 0, 0);
  mesh.tets.conservativeResize(4, 2 * tets);
  mesh.tets.rightCols(tets) = mesh.tets.leftCols(tets).array() + points;
  mesh.triangles.conservativeResize(3, 2 * triangles);
  mesh.triangles.rightCols(triangles) = mesh.triangles.leftCols(triangles).array() + points;
  auto& labels = mesh.triangle_fields["physical"];
  labels = labels.replicate(1, 2).eval();
}

/// A point of the endocardium pushed out through the wall.
void pierce(MeshData& mesh) {
  int p = 0;
  (mesh.points.colwise() - polyaffine::Vec3(7, 0, 0)).colwise().squaredNorm().minCoeff(&p);
  mesh.points.col(p) += polyaffine::Vec3(6, 0, 0);
}

const std::string kGmsh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

std::vector<WrongFile> files() {
  const auto gmsh_2 = [](const fs::path& f, const MeshData& m) { testing_io::write_gmsh_2(f, m, false); };
  const auto gmsh_4 = [](const fs::path& f, const MeshData& m) { testing_io::write_gmsh_4(f, m, true); };
  const auto stl = [](const fs::path& f, const MeshData& m) { testing_io::write_stl(f, m, true); };
  const auto ply = [](const fs::path& f, const MeshData& m) { testing_io::write_ply(f, m, true); };
  return {
      {"missing_file", "none.msh", [](const fs::path&) {}, {"none.msh", "no such file"}},
      {"unknown_extension", "heart.step", text("solid"), {"\".step\"", "expected", ".msh", ".stl"}},
      {"no_length_unit", "heart.msh", text(kGmsh), {"--length-unit"}, ""},
      {"unknown_length_unit", "heart.msh", text(kGmsh), {"\"inch\"", "mm, cm, m"}, "--length-unit inch"},
      {"empty_file", "heart.msh", text(""), {"heart.msh", "empty file"}},
      {"wrong_xml",
       "heart.vtu",
       text("<?xml version=\"1.0\"?><html><body/></html>"),
       {"heart.vtu", "expected a VTK XML file"}},
      {"polydata_as_grid",
       "heart.vtk",
       text("# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n"
            "DIMENSIONS 2 2 2\nORIGIN 0 0 0\nSPACING 1 1 1\n"),
       {"heart.vtk", "expected a mesh"}},
      {"binary_garbage",
       "heart.vtk",
       text(std::string("\x7f"
                        "ELF\x02\x01\x00\x00\xff\xfe garbage",
                        18)),
       {"heart.vtk", "damaged", "legacy VTK"}},
      {"legacy_vtk_cut_off",
       "heart.vtk",
       cut_off(testing_io::write_legacy_vtk, 0.5),
       {"heart.vtk", "damaged"}},
      {"gmsh_text_cut_off", "heart.msh", cut_off(gmsh_2, 0.6), {"heart.msh:", "cut off"}},
      {"gmsh_binary_cut_off", "heart.msh", cut_off(gmsh_4, 0.4), {"heart.msh:", "cut off"}},
      {"gmsh_of_an_old_version",
       "heart.msh",
       text("$MeshFormat\n4.0 0 8\n$EndMeshFormat\n"),
       {"4.0", "2.2 or 4.1"}},
      {"gmsh_hexahedra",
       "heart.msh",
       text(kGmsh + "$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n1 5 2 1 1 1 1 1 1 1 1 1 1\n$EndElements\n"),
       {"heart.msh:10", "hexahedron", "expected", "tetrahedra"}},
      {"vtu_hexahedra",
       "heart.vtu",
       [](const fs::path& file) {
         RawMesh mesh = raw(land_mesh());
         mesh.cells.push_back({kVtkHexahedron, {0, 1, 2, 3, 4, 5, 6, 7}, 0});
         write_raw(file, mesh);
       },
       {"cell", "hexahedron", "expected 10 (tetrahedron)"}},
      {"point_out_of_range",
       "heart.vtu",
       [](const fs::path& file) {
         RawMesh mesh = raw(land_mesh());
         mesh.cells[3].points[2] = 123456;
         write_raw(file, mesh);
       },
       {"cell 3", "point 123456", "expected 0 to"}},
      {"opencarp_without_cells", "heart.pts", text("1\n0 0 0\n"), {"heart.elem", "no such file"}},
      {"opencarp_with_words",
       "heart.pts",
       text("2\n0 0 0\n1 one 1\n"),
       {"heart.pts:3", "\"one\"", "coordinate"}},
      {"no_tets", "heart.msh", damaged([](MeshData& m) { m.tets.resize(4, 0); }), {"no tetrahedra"}},
      {"coordinate_not_a_number",
       "heart.msh",
       damaged([](MeshData& m) { m.points(1, 5) = std::numeric_limits<double>::quiet_NaN(); }),
       {"point 5", "not a number"}},
      {"flat_tets",
       "heart.msh",
       damaged([](MeshData& m) {
         m.points.col(m.tets(0, 0)) = m.points(Eigen::all, m.tets.col(0).tail(3)).rowwise().mean();
       }),
       {"is flat", "near (", "mm³"}},
      {"inverted_tets", "heart.msh", damaged(pierce), {"is inverted", "near (", "mm"}},
      {"two_components",
       "heart.msh",
       damaged(add_second_body),
       {"is isolated", "near (", "expected one connected"}},
      {"missing_label",
       "heart.msh",
       damaged(relabelled({{1, 1}, {2, 2}, {3, 9}})),
       {"label 3", "\"base\"", "labels found: 1, 2, 9"}},
      {"swapped_endo_and_epi",
       "heart.msh",
       damaged(relabelled({{1, 2}, {2, 1}, {3, 3}})),
       {"endocardium", "surrounds no cavity", "swapped"}},
      {"swapped_endo_and_base",
       "heart.msh",
       damaged(relabelled({{1, 3}, {2, 2}, {3, 1}})),
       {"endocardium", "surrounds no cavity", "swapped"}},
      {"swapped_epi_and_base",
       "heart.msh",
       damaged(relabelled({{1, 1}, {2, 3}, {3, 2}})),
       {"epicardium", "does not surround", "swapped"}},
      {"label_that_is_not_there",
       "heart.msh",
       damaged([](MeshData&) {}),
       {"label 7", "labels found: 1, 2, 3"},
       "--length-unit mm --epi-label 7"},
      {"label_array_that_is_not_there",
       "heart.msh",
       damaged([](MeshData&) {}),
       {"\"physical\"", "\"faces\""},
       "--length-unit mm --label-array faces"},
      {"fibres_of_length_zero",
       "heart.msh",
       damaged([](MeshData& m) {
         m.tet_fields["fibre"] = polyaffine::Matrix::Ones(3, m.tets.cols());
         m.tet_fields["fibre"].col(11).setZero();
       }),
       {"\"fibre\"", "length 0", "tet 11", "expected fibre directions"}},
      {"fibres_not_a_number",
       "heart.msh",
       damaged([](MeshData& m) {
         m.tet_fields["fibre"] = polyaffine::Matrix::Ones(3, m.tets.cols());
         m.tet_fields["fibre"](0, 4) = std::numeric_limits<double>::quiet_NaN();
       }),
       {"\"fibre\"", "not a finite number"}},
      {"surface_cut_off", "heart.stl", cut_off(stl, 0.7), {"heart.stl", "cut off"}},
      {"ply_cut_off", "heart.ply", cut_off(ply, 0.7), {"heart.ply", "cut off"}},
      {"surface_of_words", "heart.obj", text("v 0 0 0\nf 1 2 x\n"), {"heart.obj:2"}},
      {"open_surface",
       "heart.off",
       surface([](MeshData& m) { m.triangles = m.triangles.rightCols(m.triangles.cols() - 1).eval(); }),
       {"3 edges of one triangle", "near (", "closed surface"}},
      {"two_surfaces", "heart.off", surface(add_second_body), {"2 separate surfaces", "near ("}},
      {"self_intersecting_surface", "heart.off", surface(pierce), {"intersect", "near (", "mm"}},
      {"surface_without_a_cavity",
       "heart.off",
       surface([](MeshData& m) {
         m.points.resize(3, 4);
         m.points << 0, 30, 0, 0, 0, 0, 30, 0, 0, 0, 0, 30;
         m.triangles.resize(3, 4);
         m.triangles << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
       }),
       {"no cavity", "expected one or two ventricles"},
       "--length-unit mm --size 12"},
      {"size_for_a_mesh", "heart.msh", damaged([](MeshData&) {}), {"--size"}, "--length-unit mm --size 3"},
      {"size_of_nothing",
       "heart.off",
       surface([](MeshData&) {}),
       {"--size", "positive"},
       "--length-unit mm --size 0"},
  };
}

class ImportWrongInput : public testing::TestWithParam<WrongFile> {};

TEST_P(ImportWrongInput, IsStatusTwoWithAClearMessageAndTouchesNothing) {
  const TemporaryFolder folder;
  const WrongFile& wrong = GetParam();
  const fs::path out = folder.path / "out.vtu";
  write_text(out, "earlier");
  wrong.make(folder.path / wrong.file);
  const ProgramRun run = run_program("mesh import " + (folder.path / wrong.file).string() + ' ' +
                                     wrong.options + " --out " + out.string());
  if (run.err.find("POLYAFFINE_WITH_CGAL") != std::string::npos) GTEST_SKIP() << run.err;
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(run.err, StartsWith("cardiac: error: "));
  for (const std::string& part : wrong.message) EXPECT_THAT(run.err, HasSubstr(part));
  EXPECT_EQ(whole_file(out), "earlier");
}

INSTANTIATE_TEST_SUITE_P(Files, ImportWrongInput, testing::ValuesIn(files()),
                         [](const auto& file) { return file.param.name; });

}  // namespace
