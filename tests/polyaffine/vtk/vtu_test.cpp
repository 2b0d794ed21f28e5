#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fstream>
#include <polyaffine/core/error.hpp>
#include <polyaffine/vtk/read.hpp>
#include <polyaffine/vtk/write.hpp>

#include "polyaffine/mesh/unit_cube.hpp"

namespace polyaffine {
namespace {

using std::filesystem::path;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Vtu : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("polyaffine_vtk_" + std::to_string(getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  path in(const std::string& name) const { return folder_ / name; }

  path write_text(const std::string& name, const std::string& text) const {
    std::ofstream(in(name)) << text;
    return in(name);
  }

  /// One tet in ASCII with replaceable parts; cells after the tet are given as text.
  path ascii(const std::string& name, const std::string& more_points, const std::string& cells,
             const std::string& offsets, const std::string& types, const std::string& cell_data,
             const std::string& first_point = "0 0 0") const {
    const auto count = [](const std::string& words) {
      std::istringstream in(words);
      std::string word;
      int n = 0;
      while (in >> word) ++n;
      return n;
    };
    const int points = 4 + count(more_points) / 3, num_cells = count(types);
    return write_text(
        name,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
            std::to_string(points) + "\" NumberOfCells=\"" + std::to_string(num_cells) + "\">\n<CellData>" +
            cell_data +
            "</CellData>\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
            first_point + " 1 0 0 0 1 0 0 0 1 " + more_points +
            "</DataArray></Points>\n<Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
            "format=\"ascii\">" +
            cells + "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offsets +
            "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" + types +
            "</DataArray></Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
  }

  static std::string int_array(const std::string& name, const std::string& values) {
    return "<DataArray type=\"Int32\" Name=\"" + name + "\" format=\"ascii\">" + values + "</DataArray>";
  }

  static std::string error_of(const std::function<void()>& act) {
    ::testing::internal::CaptureStderr();
    std::string message = "no error";
    try {
      act();
    } catch (const InputError& error) {
      message = error.what();
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "VTK printed by itself";
    return message;
  }

  static std::string read_error(const path& file, double mm_per_unit = 1, const ReadOptions& options = {}) {
    return error_of([&] { read_vtu(file, mm_per_unit, options); });
  }

  path folder_;
};

TetMesh labelled_cube() {
  const auto cube = testing::unit_cube();
  return TetMesh(cube.points, cube.tets, {1, 1, 1, 2, 2, 2}, testing::cube_labels());
}

TEST_F(Vtu, RoundTripKeepsEverythingExactly) {
  const TetMesh mesh = labelled_cube();
  WriteFields fields;
  fields.point_fields["displacement_mm"] = Matrix::Random(3, mesh.num_points());
  fields.cell_fields["fibre"] = Matrix::Random(3, mesh.num_tets());
  fields.cell_fields["segment"] = Matrix::Random(1, mesh.num_tets());
  write_vtu(in("cube.vtu"), mesh, fields);

  const MeshFile back = read_mesh_file(in("cube.vtu"), 1, {.fields = true});
  EXPECT_EQ(back.mesh.points(), mesh.points());
  EXPECT_EQ(back.mesh.tets(), mesh.tets());
  EXPECT_EQ(back.mesh.regions(), mesh.regions());
  EXPECT_EQ(back.mesh.boundary(), mesh.boundary());
  EXPECT_EQ(back.mesh.boundary_labels(), mesh.boundary_labels());
  EXPECT_EQ(back.point_fields, fields.point_fields);
  EXPECT_EQ(back.cell_fields, fields.cell_fields);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1) << "a temporary file is left";
}

TEST_F(Vtu, ComponentsAndTextsAreNamed) {
  const TetMesh mesh = labelled_cube();
  WriteFields fields;
  fields.cell_fields["strain"] = Matrix::Random(2, mesh.num_tets());
  fields.components = {{"strain", {"along", "across"}}};
  fields.integer_cell_fields["part"].assign(mesh.num_tets(), 7);
  fields.texts["names"] = {"one", "two, with \"quotes\""};
  fields.values["time_ms"] = 12.5;
  fields.single = {"strain"};
  write_vtu(in("named.vtu"), mesh, fields);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(in("named.vtu").c_str());
  reader->Update();
  vtkCellData* cells = reader->GetOutput()->GetCellData();
  EXPECT_STREQ(cells->GetArray("strain")->GetComponentName(1), "across");
  EXPECT_EQ(cells->GetArray("strain")->GetTuple2(3)[1],
            static_cast<float>(fields.cell_fields["strain"](1, 3)));
  ASSERT_NE(vtkIntArray::SafeDownCast(cells->GetArray("part")), nullptr);
  EXPECT_EQ(cells->GetArray("part")->GetTuple1(0), 7);
  vtkFieldData* all = reader->GetOutput()->GetFieldData();
  EXPECT_EQ(vtkStringArray::SafeDownCast(all->GetAbstractArray("names"))->GetValue(1),
            "two, with \"quotes\"");
  EXPECT_EQ(all->GetArray("time_ms")->GetTuple1(0), 12.5);
  // The project's own reader takes it too.
  EXPECT_EQ(read_vtu(in("named.vtu"), 1).num_tets(), mesh.num_tets());
  fields.components = {{"strain", {"along"}}};
  EXPECT_THROW(write_vtu(in("named.vtu"), mesh, fields), InputError);
}

// Cubes beside each other, so that arrays take several blocks.
TetMesh many_cubes(int count) {
  const auto cube = testing::unit_cube();
  Points points(3, 4 * (count + 1));
  for (Eigen::Index k = 0; k < points.cols(); ++k)
    points.col(k) << static_cast<double>(k / 4), static_cast<double>(k / 2 % 2), static_cast<double>(k % 2);
  Tets tets(4, cube.tets.cols() * count);
  for (Eigen::Index t = 0; t < tets.cols(); ++t)
    for (int k = 0; k < 4; ++k) {
      const Vec3 X = cube.points.col(cube.tets(k, t % cube.tets.cols()));
      tets(k, t) = static_cast<int>(4 * (t / cube.tets.cols() + X.x()) + 2 * X.y() + X.z());
    }
  return {points, tets};
}

TEST_F(Vtu, LongArraysOfManyBlocksComeBack) {
  const TetMesh mesh = many_cubes(8191);
  ASSERT_EQ(mesh.num_points() * sizeof(double), std::size_t{1} << 18U) << "\"whole\" is to be a whole block";
  WriteFields fields;
  fields.point_fields["noise"] = Matrix::Random(3, mesh.num_points());  // does not shrink
  fields.point_fields["even"] = Matrix::Constant(3, mesh.num_points(), 0.1);
  fields.point_fields["whole"] = Matrix::Random(1, mesh.num_points());
  fields.cell_fields["half"] = Matrix::Random(2, mesh.num_tets());
  fields.cell_fields["half"].leftCols(mesh.num_tets() / 2).setZero();
  write_vtu(in("long.vtu"), mesh, fields);
  const auto expect_back = [&](const MeshFile& back) {
    EXPECT_EQ(back.mesh.points(), mesh.points());
    EXPECT_EQ(back.mesh.tets(), mesh.tets());
    EXPECT_EQ(back.point_fields, fields.point_fields);
    EXPECT_EQ(back.cell_fields, fields.cell_fields);
  };
  expect_back(read_mesh_file(in("long.vtu"), 1, {.fields = true}));
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(in("long.vtu").c_str());
  reader->Update();
  vtkPointData* points = reader->GetOutput()->GetPointData();
  for (const char* name : {"noise", "even"})
    for (vtkIdType k = 0; k < mesh.num_points(); k += 997)
      EXPECT_EQ(points->GetArray(name)->GetTuple3(k)[2], fields.point_fields[name](2, k)) << name << k;
  const auto numbers = 10 * mesh.num_points() + 6 * mesh.num_tets();  // of them 3 and 2 a point do not shrink
  EXPECT_LT(std::filesystem::file_size(in("long.vtu")), numbers * sizeof(double) / 2);
}

TEST_F(Vtu, NamesMayHoldWhatXmlMeansSomethingBy) {
  const TetMesh mesh = labelled_cube();
  const std::string name = "a<b & \"c\">";
  WriteFields fields;
  fields.point_fields[name] = Matrix::Random(1, mesh.num_points());
  fields.components[name] = {"<&>"};
  write_vtu(in("names.vtu"), mesh, fields);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(in("names.vtu").c_str());
  reader->Update();
  vtkDataArray* found = reader->GetOutput()->GetPointData()->GetArray(name.c_str());
  ASSERT_NE(found, nullptr);
  EXPECT_STREQ(found->GetComponentName(0), "<&>");
  EXPECT_EQ(read_mesh_file(in("names.vtu"), 1, {.fields = true}).point_fields, fields.point_fields);
}

TEST_F(Vtu, FilesOfASeriesAreThoseWrittenAlone) {
  const TetMesh mesh = labelled_cube();
  WriteFields constant;
  constant.integer_cell_fields["part"] = {1, 2, 3, 4, 5, 6};
  constant.point_fields["a_constant"] = Matrix::Random(2, mesh.num_points());
  constant.texts["a_text"] = {"x"};
  const VtuSeries series(mesh, constant);
  for (const double time : {0.0, 1.0}) {
    WriteFields fields;
    fields.points = (1 + time) * mesh.points();
    fields.point_fields["moving"] = Matrix::Random(3, mesh.num_points());
    fields.values["time_ms"] = time;
    series.write(in("one.vtu"), fields);
    const MeshFile back = read_mesh_file(in("one.vtu"), 1, {.fields = true});
    EXPECT_EQ(back.mesh.points(), fields.points);
    EXPECT_EQ(back.mesh.boundary_labels(), mesh.boundary_labels());
    EXPECT_EQ(back.point_fields.at("moving"), fields.point_fields["moving"]);
    EXPECT_EQ(back.point_fields.at("a_constant"), constant.point_fields["a_constant"]);
    EXPECT_EQ(back.cell_fields.at("part")(0, 3), 4);
    fields.integer_cell_fields = constant.integer_cell_fields;
    fields.point_fields.insert(constant.point_fields.begin(), constant.point_fields.end());
    fields.texts = constant.texts;
    write_vtu(in("alone.vtu"), mesh, fields);
    EXPECT_EQ(std::filesystem::file_size(in("one.vtu")), std::filesystem::file_size(in("alone.vtu")));
  }
  constant.point_fields["a_constant"] = Matrix::Zero(2, 3);
  EXPECT_THAT(error_of([&] { VtuSeries(mesh, constant); }), HasSubstr("\"a_constant\": found 2 × 3"));
}

TEST_F(Vtu, DeformedPointsReplaceTheReference) {
  const TetMesh mesh = labelled_cube();
  WriteFields fields;
  fields.points = 2 * mesh.points();
  write_vtu(in("cube.vtu"), mesh, fields);
  EXPECT_EQ(read_vtu(in("cube.vtu"), 1).points(), fields.points);
}

TEST_F(Vtu, LengthUnitScalesPoints) {
  write_vtu(in("cube.vtu"), labelled_cube());
  EXPECT_EQ(read_vtu(in("cube.vtu"), 10).points(), 10 * labelled_cube().points());
  for (const double unit : {0.0, -1.0, std::nan("")})
    EXPECT_THAT(read_error(in("cube.vtu"), unit), AllOf(HasSubstr("length unit"), HasSubstr("positive")));
}

TEST_F(Vtu, DropsPointsThatNoTetUses) {
  const auto file = ascii("extra.vtu", "9 9 9", "0 1 2 3", "4", "10", "");
  EXPECT_EQ(read_vtu(file, 1).num_points(), 4);
}

TEST_F(Vtu, TrianglesOnTheirOwnPointsAreJoinedByCoordinates) {
  const auto file =
      ascii("own.vtu", "1e-9 0 0 1 0 0 0 1 0", "0 1 2 3 4 5 6", "4 7", "10 5", int_array("label", "0 7"));
  const TetMesh mesh = read_vtu(file, 1);
  EXPECT_EQ(mesh.num_points(), 4);
  EXPECT_EQ(mesh.surface({7}).cols(), 1);
  EXPECT_EQ(mesh.surface_points({7}), (std::vector<int>{0, 1, 2}));
}

TEST_F(Vtu, SurfaceFromASecondFile) {
  const auto cube = testing::unit_cube();
  write_vtu(in("volume.vtu"), TetMesh(cube.points, cube.tets));
  const auto surface = ascii("surface.vtu", "1 1 0", "0 1 4", "3", "5", int_array("kind", "4"));
  const TetMesh mesh = read_vtu(in("volume.vtu"), 1, {.label_array = "kind", .surface_file = surface});
  EXPECT_EQ(mesh.surface_points({4}), (std::vector<int>{0, 1, 3}));
  const auto diagonal = ascii("diagonal.vtu", "", "1 2 3", "3", "5", int_array("surface", "4"));
  EXPECT_THAT(read_error(in("volume.vtu"), 1, {.surface_file = diagonal}),
              HasSubstr("not a face of the boundary"));
  EXPECT_THAT(read_error(in("volume.vtu"), 1, {.surface_file = in("volume.vtu")}),
              HasSubstr("found no triangles"));
}

TEST_F(Vtu, ErrorsNameTheFileAndTheFault) {
  write_vtu(in("cube.vtu"), labelled_cube());
  EXPECT_THAT(read_error(in("none.vtu")), AllOf(HasSubstr("none.vtu"), HasSubstr("no such file")));
  EXPECT_THAT(read_error(in("cube.stl")), AllOf(HasSubstr("\".stl\""), HasSubstr("expected .vtu")));
  EXPECT_THAT(read_error(write_text("garbage.vtu", "this is no mesh")),
              AllOf(HasSubstr("garbage.vtu"), HasSubstr("end of the file")));
  EXPECT_THAT(read_error(write_text("empty.vtu", "")), HasSubstr("empty.vtu"));
  EXPECT_THAT(read_error(write_text("other.vtu", "<?xml version=\"1.0\"?><html></html>")),
              HasSubstr("other.vtu"));
}

TEST_F(Vtu, TruncatedFileIsAnError) {
  write_vtu(in("cube.vtu"), labelled_cube());
  const auto size = std::filesystem::file_size(in("cube.vtu"));
  for (const auto part : {size / 4, size / 2, size - 100}) {
    std::filesystem::copy_file(in("cube.vtu"), in("cut.vtu"),
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(in("cut.vtu"), part);
    EXPECT_THAT(read_error(in("cut.vtu")), HasSubstr("cut.vtu")) << part << " bytes of " << size;
  }
}

TEST_F(Vtu, OtherCellsAreNamed) {
  const auto file =
      ascii("mixed.vtu", "1 1 0 0 1 1 1 1 1 1 0 1", "0 1 2 3 0 1 4 2 3 7 6 5", "4 12", "10 12", "");
  EXPECT_THAT(read_error(file),
              AllOf(HasSubstr("hexahedron"), HasSubstr("cell 1"), HasSubstr("tetrahedron")));
}

TEST_F(Vtu, LabelArrayFaults) {
  const auto bare = ascii("bare.vtu", "", "0 1 2 3 0 1 2", "4 7", "10 5", int_array("colour", "0 1"));
  EXPECT_THAT(read_error(bare), AllOf(HasSubstr("no label array"), HasSubstr("\"colour\"")));
  EXPECT_EQ(read_vtu(bare, 1, {.label_array = "colour"}).surface({1}).cols(), 1);
  EXPECT_THAT(read_error(bare, 1, {.label_array = "wall"}), HasSubstr("\"wall\""));
  const auto half = ascii("half.vtu", "", "0 1 2 3 0 1 2", "4 7", "10 5",
                          "<DataArray type=\"Float64\" Name=\"surface\" format=\"ascii\">0 1.5</DataArray>");
  EXPECT_THAT(read_error(half), AllOf(HasSubstr("1.5"), HasSubstr("integer")));
  const auto tets_only = ascii("tets.vtu", "", "0 1 2 3", "4", "10", "");
  EXPECT_THAT(read_error(tets_only, 1, {.label_array = "surface"}), HasSubstr("no triangles"));
}

TEST_F(Vtu, MeshFaultsCarryTheFileName) {
  const auto nan = ascii("nan.vtu", "", "0 1 2 3", "4", "10", "", "nan 0 0");
  EXPECT_THAT(read_error(nan), HasSubstr("nan.vtu"));
  WriteFields fields;
  fields.points = labelled_cube().points();
  fields.points(1, 3) = std::nan("");
  write_vtu(in("binary_nan.vtu"), labelled_cube(), fields);
  EXPECT_THAT(read_error(in("binary_nan.vtu")),
              AllOf(HasSubstr("binary_nan.vtu"), HasSubstr("not a number")));
  const auto inside = ascii("far.vtu", "5 5 5", "0 1 2 3 0 1 4", "4 7", "10 5", int_array("surface", "0 1"));
  EXPECT_THAT(read_error(inside), AllOf(HasSubstr("far.vtu"), HasSubstr("away from every tet vertex")));
  const auto flat = ascii("flat.vtu", "1 1 0", "0 1 2 4", "4", "10", "");
  EXPECT_THAT(read_error(flat), AllOf(HasSubstr("flat.vtu"), HasSubstr("flat")));
}

TEST_F(Vtu, FieldsWithNaNAreAnError) {
  WriteFields fields;
  fields.point_fields["f"] = Matrix::Constant(1, 8, std::nan(""));
  write_vtu(in("field.vtu"), labelled_cube(), fields);
  EXPECT_EQ(read_error(in("field.vtu")), "no error") << "fields that nobody asked for do not matter";
  EXPECT_THAT(read_error(in("field.vtu"), 1, {.fields = true}), HasSubstr("\"f\""));
}

TEST_F(Vtu, WriteFaultsLeaveTheOldFileAlone) {
  const TetMesh mesh = labelled_cube();
  write_vtu(in("cube.vtu"), mesh);
  const auto size = std::filesystem::file_size(in("cube.vtu"));
  WriteFields fields;
  fields.point_fields["p"] = Matrix::Zero(3, 7);
  EXPECT_THAT(error_of([&] { write_vtu(in("cube.vtu"), mesh, fields); }),
              AllOf(HasSubstr("\"p\""), HasSubstr("8 points")));
  EXPECT_EQ(std::filesystem::file_size(in("cube.vtu")), size);
  EXPECT_THAT(error_of([&] { write_vtu(in("cube.vtk"), mesh); }), HasSubstr("expected .vtu"));
  EXPECT_THAT(error_of([&] { write_vtu(in("absent") / "cube.vtu", mesh); }), HasSubstr("no folder"));
}

TEST_F(Vtu, CollectionNamesFilesRelativeToItself) {
  write_pvd(in("heart.pvd"), {0, 12.5}, {in("heart_0.vtu"), in("heart_1.vtu")});
  std::ifstream file(in("heart.pvd"));
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_THAT(text, AllOf(HasSubstr("timestep=\"12.5\" part=\"0\" file=\"heart_1.vtu\""),
                          HasSubstr("timestep=\"0\" part=\"0\" file=\"heart_0.vtu\"")));
  EXPECT_THAT(error_of([&] { write_pvd(in("heart.pvd"), {0}, {}); }), HasSubstr("1 times for 0 files"));
}

}  // namespace
}  // namespace polyaffine
