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
  read_changed(
      PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu",
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
               3000);
}

}  // namespace
}  // namespace polyaffine
