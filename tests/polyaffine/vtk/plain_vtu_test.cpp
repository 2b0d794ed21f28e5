#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <numeric>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh_io/vtu.hpp>

#include "support/error_of.hpp"
#include "support/file_fuzz.hpp"
#include "support/labelled_box.hpp"
#include "support/temporary_folder.hpp"

namespace polyaffine {
namespace {

using std::filesystem::path;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// How VTK writes a file.
struct Coding {
  const char* name;
  int mode;
  bool base64, zlib, wide;
  bool big_endian = false;
};

const std::vector<Coding> kCodings{
    {"text", vtkXMLWriter::Ascii, true, false, false},
    {"binary", vtkXMLWriter::Binary, true, false, false},
    {"binary_wide", vtkXMLWriter::Binary, true, false, true},
    {"binary_zlib", vtkXMLWriter::Binary, true, true, false},
    {"raw", vtkXMLWriter::Appended, false, false, true},
    {"raw_zlib", vtkXMLWriter::Appended, false, true, false},
    {"base64", vtkXMLWriter::Appended, true, false, false},
    {"base64_zlib_wide", vtkXMLWriter::Appended, true, true, true},
    {"big_endian", vtkXMLWriter::Binary, true, false, false, true},
    {"big_endian_raw_zlib_wide", vtkXMLWriter::Appended, false, true, true, true},
};

template <class Array, class Value>
vtkSmartPointer<Array> array(const char* name, int components, vtkIdType tuples, const Value& value) {
  auto out = vtkSmartPointer<Array>::New();
  out->SetName(name);
  out->SetNumberOfComponents(components);
  out->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < components * tuples; ++i) out->SetValue(i, value(i));
  return out;
}

/// Tets, a quadratic one, a line and the triangles of a box, with fields of four types; each block of zlib
/// holds 4 kB, so that the arrays have several and a last one that is shorter.
void write(const path& file, const Coding& coding, int cells_a_side = 6,
           int compressor = vtkXMLWriter::ZLIB) {
  const TetMesh mesh = testing::labelled_cube(cells_a_side);
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (const auto& x : mesh.points().colwise()) points->InsertNextPoint(x[0] / 3, x[1], -x[2]);
  grid->SetPoints(points);
  const auto insert = [&](int type, const std::vector<vtkIdType>& of) {
    grid->InsertNextCell(type, static_cast<vtkIdType>(of.size()), of.data());
  };
  for (const auto& tet : mesh.tets().colwise()) insert(VTK_TETRA, {tet[0], tet[1], tet[2], tet[3]});
  insert(VTK_LINE, {0, 1});
  for (const auto& face : mesh.boundary().colwise()) insert(VTK_TRIANGLE, {face[0], face[1], face[2]});
  insert(VTK_QUADRATIC_TETRA, {0, 1, 2, 3, 4, 5, 6, 7, 0, 1});
  const vtkIdType n = grid->GetNumberOfPoints(), cells = grid->GetNumberOfCells();
  const auto wave = [](vtkIdType i) { return std::sin(0.7 * static_cast<double>(i)) / 3; };
  grid->GetPointData()->AddArray(array<vtkDoubleArray>("two words", 3, n, wave));
  grid->GetPointData()->AddArray(
      array<vtkFloatArray>("f", 1, n, [&](vtkIdType i) { return static_cast<float>(wave(i)); }));
  grid->GetCellData()->AddArray(
      array<vtkIntArray>("surface", 1, cells, [](vtkIdType i) { return static_cast<int>(i % 5 - 2); }));
  grid->GetCellData()->AddArray(array<vtkUnsignedCharArray>(
      "kind", 2, cells, [](vtkIdType i) { return static_cast<unsigned char>(i % 256); }));
  const auto writer = vtkSmartPointer<vtkXMLUnstructuredGridWriter>::New();
  writer->SetFileName(file.c_str());
  writer->SetInputData(grid);
  writer->SetDataMode(coding.mode);
  writer->SetEncodeAppendedData(coding.base64);
  writer->SetCompressorType(coding.zlib ? compressor : vtkXMLWriter::NONE);
  writer->SetBlockSize(4096);
  coding.big_endian ? writer->SetByteOrderToBigEndian() : writer->SetByteOrderToLittleEndian();
  coding.wide ? writer->SetHeaderTypeToUInt64() : writer->SetHeaderTypeToUInt32();
  ASSERT_EQ(writer->Write(), 1);
}

/// The cells of these types: their numbers and, a column each, their corners.
struct CellsOfKind {
  std::vector<vtkIdType> numbers;
  Eigen::MatrixXi corners;
};
CellsOfKind cells_of(vtkUnstructuredGrid& grid, int corners, int linear, int quadratic) {
  CellsOfKind out;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c)
    if (grid.GetCellType(c) == linear || grid.GetCellType(c) == quadratic) out.numbers.push_back(c);
  out.corners.resize(corners, static_cast<Eigen::Index>(out.numbers.size()));
  for (Eigen::Index k = 0; k < out.corners.cols(); ++k)
    for (int i = 0; i < corners; ++i)
      out.corners(i, k) = static_cast<int>(grid.GetCell(out.numbers[k])->GetPointId(i));
  return out;
}

/// The tuples with these numbers of every array.
std::map<std::string, Matrix> fields_of(vtkFieldData& arrays, const std::vector<vtkIdType>& numbers) {
  std::map<std::string, Matrix> out;
  for (int i = 0; i < arrays.GetNumberOfArrays(); ++i) {
    vtkDataArray* of = arrays.GetArray(i);
    Matrix& field = out[of->GetName()];
    field.resize(of->GetNumberOfComponents(), static_cast<Eigen::Index>(numbers.size()));
    for (Eigen::Index k = 0; k < field.cols(); ++k) of->GetTuple(numbers[k], field.col(k).data());
  }
  return out;
}

void expect_as_vtk_reads(const path& file) {
  const auto reader = vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  std::vector<vtkIdType> points(grid.GetNumberOfPoints());
  std::iota(points.begin(), points.end(), 0);
  const CellsOfKind tets = cells_of(grid, 4, VTK_TETRA, VTK_QUADRATIC_TETRA);
  const CellsOfKind triangles = cells_of(grid, 3, VTK_TRIANGLE, VTK_QUADRATIC_TRIANGLE);
  const MeshData own = read_vtu_data(file);
  ASSERT_EQ(own.points.cols(), grid.GetNumberOfPoints());
  for (const vtkIdType p : points) EXPECT_EQ(own.points.col(p), Vec3(grid.GetPoint(p))) << p;
  EXPECT_EQ(own.source, file);
  EXPECT_EQ(own.tets, tets.corners);
  EXPECT_EQ(own.triangles, triangles.corners);
  EXPECT_EQ(own.point_fields, fields_of(*grid.GetPointData(), points));
  EXPECT_EQ(own.tet_fields, fields_of(*grid.GetCellData(), tets.numbers));
  EXPECT_EQ(own.triangle_fields, fields_of(*grid.GetCellData(), triangles.numbers));
}

std::string error_of(const path& file) {
  return testing::error_of([&] { read_vtu_data(file); });
}

class PlainVtu : public ::testing::TestWithParam<Coding> {
 protected:
  TemporaryFolder folder_;
  path file_ = folder_.path / "box.vtu";
};

TEST_P(PlainVtu, ReadsWhatVtkReads) {
  write(file_, GetParam());
  expect_as_vtk_reads(file_);
  EXPECT_GT(read_vtu_data(file_).tets.cols(), 1000);
}

TEST_P(PlainVtu, CutOffIsRefusedWithItsName) {
  write(file_, GetParam());
  const std::string whole = whole_file(file_);
  const std::size_t data = std::min(whole.find("</AppendedData>"), whole.find("</Cells>")) - 50;
  for (const std::size_t size : {std::size_t{0}, std::size_t{60}, whole.size() / 4, whole.size() / 2, data}) {
    std::ofstream(file_, std::ios::binary) << whole.substr(0, size);
    EXPECT_THAT(error_of(file_), HasSubstr("box.vtu")) << size;
  }
}

TEST_P(PlainVtu, ChangedIsAMeshOrRefused) {
  write(file_, GetParam(), 1);
  expect_read_or_refused(file_,
                         {"<DataArray ", "</DataArray>", "NumberOfPoints=\"", "NumberOfComponents=\"9\" ",
                          "<Piece ", "offset=\"", "type=\"UInt8\" ", "format=\"ascii\" ", "<", ">", "\"", "&",
                          "offsets", "\n", "/>", "<!--"},
                         1000, [&] { read_vtu_data(file_); });
}

INSTANTIATE_TEST_SUITE_P(Codings, PlainVtu, ::testing::ValuesIn(kCodings),
                         [](const auto& coding) { return std::string(coding.param.name); });

TEST(PlainVtuFile, MeshesOfTheProjectAreReadAsVtkReadsThem) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PROJECT_DIR "/meshes")) {
    if (entry.path().extension() != ".vtu") continue;
    SCOPED_TRACE(entry.path());
    expect_as_vtk_reads(entry.path());
    ++files;
  }
  EXPECT_GE(files, 5);
}

// Sizes of two blocks whose sum is small only because it exceeds 64 bits.
TEST(PlainVtuFile, BlocksOfAnyAnnouncedSizeAreRefused) {
  const TemporaryFolder folder;
  const path file = folder.path / "box.vtu";
  write(file, {"raw_zlib_wide", vtkXMLWriter::Appended, false, true, true});
  std::string bytes = whole_file(file);
  const std::size_t header = bytes.find('_', bytes.find("<AppendedData")) + 1;
  const std::array<std::uint64_t, 2> sizes{100, static_cast<std::uint64_t>(-50)};
  std::memcpy(bytes.data() + header + 3 * sizeof sizes[0], sizes.data(), sizeof sizes);
  std::ofstream(file, std::ios::binary) << bytes;
  EXPECT_THAT(error_of(file), HasSubstr("expected blocks that fit the file"));
}

TEST(PlainVtuFile, OtherCompressorsAreNamed) {
  const TemporaryFolder folder;
  const path file = folder.path / "box.vtu";
  for (const auto& [compressor, name] : {std::pair(vtkXMLWriter::LZ4, "vtkLZ4DataCompressor"),
                                         std::pair(vtkXMLWriter::LZMA, "vtkLZMADataCompressor")}) {
    write(file, {"compressed", vtkXMLWriter::Appended, false, true, true}, 1, compressor);
    EXPECT_THAT(error_of(file), AllOf(HasSubstr(name), HasSubstr("with zlib or uncompressed")));
  }
}

// As parallel programs write them: the parts of several processors, of which one may be empty.
TEST(PlainVtuFile, PiecesFollowEachOther) {
  const TemporaryFolder folder;
  const path file = folder.path / "box.vtu";
  write(file, kCodings.front(), 1);
  const MeshData one = read_vtu_data(file);
  std::string text = whole_file(file);
  const std::size_t begin = text.find("<Piece"), end = text.find("</Piece>") + 8;
  const std::string piece = text.substr(begin, end - begin);
  text.insert(end, "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"></Piece>" + piece);
  std::ofstream(file, std::ios::binary) << text;
  const MeshData two = read_vtu_data(file);
  EXPECT_EQ(two.points.leftCols(one.points.cols()), one.points);
  EXPECT_EQ(two.points.rightCols(one.points.cols()), one.points);
  const Tets moved = one.tets.array() + static_cast<int>(one.points.cols());
  EXPECT_EQ(two.tets.rightCols(one.tets.cols()), moved);
  EXPECT_EQ(two.triangle_fields.at("surface").rightCols(one.triangles.cols()),
            one.triangle_fields.at("surface"));
  std::string other = piece;
  other.replace(other.find("\"surface\""), 9, "\"outside\"");
  text.replace(text.rfind(piece), piece.size(), other);
  std::ofstream(file, std::ios::binary) << text;
  EXPECT_THAT(error_of(file), HasSubstr("pieces with different arrays"));
}

// A text file with one thing changed.
std::string error_with(const std::string& from, const std::string& to) {
  const TemporaryFolder folder;
  const path file = folder.path / "box.vtu";
  write(file, kCodings.front(), 1);
  std::string text = whole_file(file);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  std::ofstream(file, std::ios::binary) << text;
  return error_of(file);
}

TEST(PlainVtuFile, WhatItDoesNotReadIsNamed) {
  EXPECT_EQ(error_with("LittleEndian", "LittleEndian"), "no error");
  EXPECT_EQ(error_with("\"two words\"", "'&lt;&amp;\"'"), "no error");
  EXPECT_THAT(error_with("\"UnstructuredGrid\"", "\"PolyData\""), HasSubstr("UnstructuredGrid"));
  EXPECT_THAT(error_with("</Piece>", "</Piece><Piece></Piece>"), HasSubstr("NumberOfPoints"));
  EXPECT_THAT(error_with("</Piece>", "</Peace>"), HasSubstr("damaged"));
  EXPECT_THAT(error_with("NumberOfPoints=\"8\"", "NumberOfPoints=\"9\""), HasSubstr("expected 27"));
  EXPECT_THAT(error_with("NumberOfPoints=\"8\"", "NumberOfPoints=\"99999999\""),
              HasSubstr("fits the size of the file"));
  EXPECT_THAT(error_with("Name=\"types\"", "Name=\"kinds\""), HasSubstr("no array types"));
  EXPECT_THAT(error_with("10 10", "10 12"),
              AllOf(HasSubstr("cell type 12"), HasSubstr("counted from 0"), HasSubstr("10 (tetrahedron)")));
  EXPECT_THAT(error_with("10 10", "10 1e308"), HasSubstr("cell type outside 0 to 255"));
}

}  // namespace
}  // namespace polyaffine
