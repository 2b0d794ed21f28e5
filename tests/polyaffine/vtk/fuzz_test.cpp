#include <gtest/gtest.h>

#include <fstream>
#include <polyaffine/vtk/read.hpp>

#include "support/file_fuzz.hpp"
#include "support/labelled_box.hpp"
#include "support/mesh_writers.hpp"
#include "support/temporary_folder.hpp"

namespace polyaffine {
namespace {

using std::filesystem::path;

/// The tets of a mesh as readable XML, in which a change is felt where it is made.
void write_plain_vtu(const path& file, const TetMesh& mesh) {
  std::ofstream out(file);
  out << "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
      << "<Piece NumberOfPoints=\"" << mesh.num_points() << "\" NumberOfCells=\"" << mesh.num_tets()
      << "\">\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n"
      << mesh.points().transpose() << "\n</DataArray>\n</Points>\n<Cells>\n"
      << "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n"
      << mesh.tets().transpose()
      << "\n</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (int t = 1; t <= mesh.num_tets(); ++t) out << 4 * t << ' ';
  out << "\n</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  for (int t = 0; t < mesh.num_tets(); ++t) out << "10 ";
  out << "\n</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

TEST(VtkFuzz, XmlIsAMeshOrRefused) {
  const TemporaryFolder folder;
  const path file = folder.path / "box.vtu";
  write_plain_vtu(file, testing::labelled_cube(1));
  expect_read_or_refused(
      file,
      {"<DataArray ", "</DataArray>", "NumberOfPoints=\"", "NumberOfCells=\"", "<Piece ", "offset=\"",
       "type=\"Float64\" ", "format=\"ascii\" ", "<", ">", "\"", "&", "connectivity", "\n"},
      1000, [&] { read_mesh_file(file, 1, {.fields = true}); });
}

TEST(VtkFuzz, LegacyIsAMeshOrRefused) {
  const TemporaryFolder folder;
  const path file = folder.path / "box.vtk";
  testing_io::write_legacy_vtk(file, testing_io::data_of(testing::labelled_cube(1)));
  expect_read_or_refused(
      file,
      {"POINTS ", "CELLS ", "CELL_TYPES ", "CELL_DATA ", "POINT_DATA ", "SCALARS ", "VECTORS ",
       "LOOKUP_TABLE default\n", "FIELD ", "DATASET POLYDATA\n", "BINARY\n", "\n", " ", "-"},
      1000, [&] { read_mesh_file(file, 1, {.fields = true}); });
}

}  // namespace
}  // namespace polyaffine
