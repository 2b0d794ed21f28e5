#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh_io/label_fields.hpp>
#include <polyaffine/mesh_io/read.hpp>
#include <set>

#include "support/error_of.hpp"
#include "support/labelled_box.hpp"
#include "support/mesh_writers.hpp"
#include "support/temporary_folder.hpp"
#include "support/whole_file.hpp"

namespace polyaffine {
namespace {

using std::filesystem::path;
using ::testing::AllOf;
using testing::error_of;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// A box of two materials with labelled faces and a fibre in each tet.
MeshData box() {
  MeshData out = testing_io::data_of(testing::labelled_box({-1, 0, 2}, {1, 3, 4}, {2, 2, 2}, 0.1));
  Matrix& region = out.tet_fields["region"] = Matrix(1, out.tets.cols());
  for (Eigen::Index t = 0; t < region.cols(); ++t) region(0, t) = 1 + t % 2;
  out.tet_fields["fibre"] = Matrix::Random(3, out.tets.cols());
  out.surface_names = {{1, "ENDO"}, {2, "epi wall"}};
  return out;
}

/// Cells with their data, in an order that does not depend on the file's.
std::multiset<std::vector<double>> cells(const MeshData& mesh, const auto& corners,
                                         const std::map<std::string, Matrix>& fields,
                                         const std::vector<std::string>& names) {
  std::multiset<std::vector<double>> out;
  for (Eigen::Index c = 0; c < corners.cols(); ++c) {
    std::vector<double> row;
    for (const int p : corners.col(c))
      row.insert(row.end(), mesh.points.col(p).begin(), mesh.points.col(p).end());
    for (const std::string& name : names)
      row.insert(row.end(), fields.at(name).col(c).begin(), fields.at(name).col(c).end());
    out.insert(row);
  }
  return out;
}

struct VolumeFormat {
  const char* name;
  std::function<void(const path&, const MeshData&)> write;
  const char* extension;
};

const std::vector<VolumeFormat>& volume_formats() {
  using namespace testing_io;
  static const std::vector<VolumeFormat> all{
      {"gmsh_2_text", [](const path& f, const MeshData& m) { write_gmsh_2(f, m, false); }, ".msh"},
      {"gmsh_2_binary", [](const path& f, const MeshData& m) { write_gmsh_2(f, m, true); }, ".msh"},
      {"gmsh_4_text", [](const path& f, const MeshData& m) { write_gmsh_4(f, m, false); }, ".msh"},
      {"gmsh_4_binary", [](const path& f, const MeshData& m) { write_gmsh_4(f, m, true); }, ".msh"},
      {"opencarp", write_opencarp, ".pts"}};
  return all;
}

class VolumeReader : public ::testing::TestWithParam<VolumeFormat> {
 protected:
  path file() const { return folder_.path / (std::string("box") + GetParam().extension); }
  TemporaryFolder folder_;
};

TEST_P(VolumeReader, BringsEverything) {
  const MeshData given = box();
  GetParam().write(file(), given);
  const MeshData read = read_mesh_data(file());
  EXPECT_LT((read.points - given.points).norm(), 1e-12);
  const std::vector<std::string> of_tets{"region"};
  EXPECT_EQ(cells(read, read.tets, read.tet_fields, of_tets),
            cells(given, given.tets, given.tet_fields, of_tets));
  const std::string label = label_field(read, "");
  EXPECT_EQ(cells(read, read.triangles, read.triangle_fields, {label}),
            cells(given, given.triangles, given.triangle_fields, {"physical"}));
  // Text keeps as many digits as the writer gave.
  for (Eigen::Index t = 0; t < read.tets.cols(); ++t) {
    Eigen::Index same = 0;
    (given.tets.colwise() - read.tets.col(t)).cwiseAbs().colwise().sum().minCoeff(&same);
    EXPECT_LT((read.tet_fields.at("fibre").col(t) - given.tet_fields.at("fibre").col(same)).norm(), 1e-5);
  }
  if (label == "physical") {
    EXPECT_EQ(read.surface_names, given.surface_names);
  }
}

TEST_P(VolumeReader, CutAnywhereIsAnError) {
  GetParam().write(file(), box());
  const std::string cut = std::string(GetParam().name) == "opencarp" ? ".elem" : GetParam().extension;
  const path victim = path(file()).replace_extension(cut);
  const auto size = std::filesystem::file_size(victim);
  for (int part = 1; part < 20; ++part) {
    GetParam().write(file(), box());
    std::filesystem::resize_file(victim, size * part / 20 - 7);
    EXPECT_THAT(error_of([&] { read_mesh_data(file()); }), HasSubstr(victim.filename().string() + ":"))
        << part << "/20";
  }
}

TEST_P(VolumeReader, GarbageIsAnErrorOrAMeshButNeverMore) {
  GetParam().write(file(), box());
  const std::string whole = whole_file(file());
  for (int i = 0; i < 60; ++i) {
    std::string text = whole;
    for (int k = 0; k < 8; ++k)
      text[(i * 7919U + k * 104729U) % text.size()] = static_cast<char>(i * 37 + k * 91);
    std::ofstream(file(), std::ios::binary) << text;
    error_of([&] {
      const MeshData mesh = read_mesh_data(file());
      if (mesh.tets.size() > 0) {
        EXPECT_LT(mesh.tets.maxCoeff(), mesh.points.cols());
      }
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, VolumeReader, ::testing::ValuesIn(volume_formats()),
                         [](const auto& format) { return format.param.name; });

TEST(GmshReader, QuadraticTetsGiveTheirCorners) {
  const TemporaryFolder folder;
  const path file = folder.path / "one.msh";
  std::ofstream(file)
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
         "5 .5 0 0\n6 .5 .5 0\n7 0 .5 0\n8 0 0 .5\n9 0 .5 .5\n10 .5 0 .5\n$EndNodes\n"
         "$Elements\n2\n1 11 2 3 1 1 2 3 4 5 6 7 8 9 10\n2 9 2 4 1 1 3 2 7 6 5\n$EndElements\n";
  const MeshData mesh = read_mesh_data(file);
  EXPECT_EQ(mesh.tets, (Tets(4, 1) << 0, 1, 2, 3).finished());
  EXPECT_EQ(mesh.triangles, (Triangles(3, 1) << 0, 2, 1).finished());
  EXPECT_EQ(mesh.triangle_fields.at("physical")(0, 0), 4);
  ASSERT_THAT(mesh.notes, SizeIs(1));
  EXPECT_THAT(mesh.notes[0], HasSubstr("1 quadratic tetrahedra"));
}

TEST(GmshReader, RefusalsNameWhatWasFound) {
  const TemporaryFolder folder;
  const path file = folder.path / "wrong.msh";
  const auto refusal = [&](const std::string& text) {
    std::ofstream(file) << text;
    return error_of([&] { read_mesh_data(file); });
  };
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n",
                    point = "$Nodes\n1\n1 0 0 0\n$EndNodes\n";
  EXPECT_THAT(refusal("no mesh"), AllOf(HasSubstr("wrong.msh:1"), HasSubstr("$MeshFormat")));
  EXPECT_THAT(refusal("$MeshFormat\n4.0 0 8\n$EndMeshFormat\n"),
              AllOf(HasSubstr("4.0"), HasSubstr("2.2 or 4.1")));
  EXPECT_THAT(refusal(head + point + "$Elements\n1\n1 5 2 1 1 1 1 1 1 1 1 1 1\n$EndElements\n"),
              AllOf(HasSubstr("hexahedron"), HasSubstr("expected"), HasSubstr("wrong.msh:10")));
  EXPECT_THAT(refusal(head + point + "$Elements\n1\n1 4 2 1 1 1 1 1 9\n$EndElements\n"), HasSubstr("node 9"));
  EXPECT_THAT(refusal(head + "$Nodes\n1\n1 0 zero 0\n"),
              AllOf(HasSubstr("\"zero\""), HasSubstr("coordinate")));
  EXPECT_THAT(refusal(head + "$Nodes\n123456789012\n1 0 0 0\n"), HasSubstr("cut off"));
  EXPECT_THAT(refusal(head), HasSubstr("no $Nodes"));
}

TEST(OpenCarpReader, RefusalsNameFileAndLine) {
  const TemporaryFolder folder;
  const path file = folder.path / "heart.pts";
  const auto refusal = [&](const std::string& points, const std::string& cells, const std::string& fibres) {
    std::ofstream(file) << points;
    std::ofstream(folder.path / "heart.elem") << cells;
    std::ofstream(folder.path / "heart.lon") << fibres;
    return error_of([&] { read_mesh_data(folder.path / "heart.elem"); });
  };
  const std::string points = "4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n", tet = "1\nTt 0 1 2 3 1\n";
  EXPECT_EQ(refusal(points, "1\nTt 0 1 2 3\n", "1\n1 0 0\n"), "no error") << "the tag may be missing";
  EXPECT_THAT(refusal(points, "1\nHx 0 1 2 3 0 1 2 3 1\n", ""),
              AllOf(HasSubstr("heart.elem:2"), HasSubstr("hexahedron")));
  EXPECT_THAT(refusal(points, "1\nTt 0 1 2 4 1\n", ""), AllOf(HasSubstr("point 4"), HasSubstr("0 to 3")));
  EXPECT_THAT(refusal(points, tet, "1\n1 0\n"), AllOf(HasSubstr("heart.lon"), HasSubstr("fibre")));
  EXPECT_THAT(refusal(points, tet, "5\n1 0 0\n"), HasSubstr("1 or 2"));
  EXPECT_THAT(refusal("4\n0 0 0\n1 0 0\n", tet, ""), AllOf(HasSubstr("heart.pts"), HasSubstr("cut off")));
}

struct SurfaceFormat {
  const char* name;
  std::function<void(const path&, const MeshData&)> write;
  const char* extension;
};

const std::vector<SurfaceFormat>& surface_formats() {
  using namespace testing_io;
  static const std::vector<SurfaceFormat> all{
      {"stl_text", [](const path& f, const MeshData& m) { write_stl(f, m, false); }, ".stl"},
      {"stl_binary", [](const path& f, const MeshData& m) { write_stl(f, m, true); }, ".stl"},
      {"off", write_off, ".off"},
      {"obj", write_obj, ".obj"},
      {"ply_text", [](const path& f, const MeshData& m) { write_ply(f, m, false); }, ".ply"},
      {"ply_binary", [](const path& f, const MeshData& m) { write_ply(f, m, true); }, ".ply"}};
  return all;
}

class SurfaceReader : public ::testing::TestWithParam<SurfaceFormat> {
 protected:
  path file() const { return folder_.path / (std::string("box") + GetParam().extension); }
  TemporaryFolder folder_;
};

TEST_P(SurfaceReader, BringsEveryTriangle) {
  const MeshData given = box();
  GetParam().write(file(), given);
  const MeshData read = read_mesh_data(file());
  ASSERT_EQ(read.triangles.cols(), given.triangles.cols());
  for (Eigen::Index t = 0; t < read.triangles.cols(); ++t)
    EXPECT_LT(
        (read.points(Eigen::all, read.triangles.col(t)) - given.points(Eigen::all, given.triangles.col(t)))
            .norm(),
        1e-6)
        << "STL holds floats";
  if (std::string(GetParam().name).starts_with("ply")) {
    EXPECT_EQ(read.triangle_fields.at("label"), given.triangle_fields.at("physical"));
  }
}

TEST_P(SurfaceReader, CutAnywhereIsAnErrorOrHasFewerTriangles) {
  GetParam().write(file(), box());
  const auto size = std::filesystem::file_size(file());
  for (int part = 0; part < 20; ++part) {
    GetParam().write(file(), box());
    std::filesystem::resize_file(file(), size * part / 20);
    Eigen::Index triangles = 0;
    const std::string error = error_of([&] { triangles = read_mesh_data(file()).triangles.cols(); });
    if (error == "no error") {
      EXPECT_LT(triangles, box().triangles.cols());
    } else {
      EXPECT_THAT(error, HasSubstr("box."));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, SurfaceReader, ::testing::ValuesIn(surface_formats()),
                         [](const auto& format) { return format.param.name; });

TEST(SurfaceReaders, PolygonsAreCutIntoTriangles) {
  const TemporaryFolder folder;
  const path file = folder.path / "square.off";
  std::ofstream(file) << "COFF 4 1 0\n0 0 0 255 0 0\n1 0 0 1 1 1\n1 1 0 2 2 2\n0 1 0 3 3 3\n4 0 1 2 3\n";
  EXPECT_EQ(read_mesh_data(file).triangles, (Triangles(3, 2) << 0, 0, 1, 2, 2, 3).finished());
}

TEST(SurfaceReaders, PlyOfOtherByteOrder) {
  const TemporaryFolder folder;
  const path file = folder.path / "one.ply";
  std::ofstream out(file, std::ios::binary);
  out << "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
         "float z\n"
         "property uchar red\nend_header\n";
  out.write("\x3f\x80\0\0\x40\0\0\0\xbf\x80\0\0\7", 13);
  out.close();
  EXPECT_EQ(read_mesh_data(file).points.col(0), Vec3(1, 2, -1));
}

TEST(Readers, UnknownExtensionsAreNamed) {
  EXPECT_FALSE(has_reader("heart.step"));
  EXPECT_THAT(error_of([] { read_mesh_data("heart.step"); }),
              AllOf(HasSubstr("\".step\""), HasSubstr(".msh")));
  EXPECT_THAT(error_of([] { read_mesh_data("none.msh"); }), HasSubstr("no such file"));
}

}  // namespace
}  // namespace polyaffine
