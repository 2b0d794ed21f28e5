#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <polyaffine/core/error.hpp>
#include <polyaffine/vtk/read.hpp>
#include <sstream>

#include "support/labelled_box.hpp"
#include "support/mesh_writers.hpp"
#include "support/mutation.hpp"
#include "support/temporary_folder.hpp"

namespace polyaffine {
namespace {

using std::filesystem::path;

std::string bytes_of(const path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

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

/// Reads as many changed files as asked; each is a mesh or refused with a message that names the file.
void read_changed(const path& sample, const std::vector<std::string>& words, int inputs) {
  const TemporaryFolder folder;
  const path file = folder.path / ("changed" + sample.extension().string());
  Mutator mutator({bytes_of(sample)}, words, 1);
  int accepted = 0;
  for (int k = 0; k < inputs; ++k) {
    const std::string bytes = mutator.next();
    std::filesystem::remove(file);  // writing over a file waits for the disk
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      read_mesh_file(file, 1, {.fields = true});
      ++accepted;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("changed."), std::string::npos) << error.what();
    } catch (const std::exception& error) {
      FAIL() << "input " << k << ": " << error.what() << "\n" << bytes;
    }
  }
  EXPECT_GT(accepted, inputs / 100) << "the inputs are so wrong that little is tried";
  EXPECT_LT(accepted, inputs) << "the inputs are not wrong";
}

TEST(VtkFuzz, XmlIsAMeshOrRefused) {
  const TemporaryFolder folder;
  write_plain_vtu(folder.path / "box.vtu", testing::labelled_cube(1));
  read_changed(
      folder.path / "box.vtu",
      {"<DataArray ", "</DataArray>", "NumberOfPoints=\"", "NumberOfCells=\"", "<Piece ", "offset=\"",
       "type=\"Float64\" ", "format=\"ascii\" ", "<", ">", "\"", "&", "connectivity", "\n"},
      1000);
}

TEST(VtkFuzz, LegacyIsAMeshOrRefused) {
  const TemporaryFolder folder;
  testing_io::write_legacy_vtk(folder.path / "box.vtk", testing_io::data_of(testing::labelled_cube(1)));
  read_changed(folder.path / "box.vtk",
               {"POINTS ", "CELLS ", "CELL_TYPES ", "CELL_DATA ", "POINT_DATA ", "SCALARS ", "VECTORS ",
                "LOOKUP_TABLE default\n", "FIELD ", "DATASET POLYDATA\n", "BINARY\n", "\n", " ", "-"},
               1000);
}

}  // namespace
}  // namespace polyaffine
