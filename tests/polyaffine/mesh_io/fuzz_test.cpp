#include <gtest/gtest.h>

#include <functional>
#include <polyaffine/mesh_io/assemble.hpp>
#include <polyaffine/mesh_io/closed_surface.hpp>
#include <polyaffine/mesh_io/read.hpp>

#include "support/file_fuzz.hpp"
#include "support/labelled_box.hpp"
#include "support/mesh_writers.hpp"
#include "support/temporary_folder.hpp"

namespace polyaffine {
namespace {

using std::filesystem::path;

struct Format {
  const char* name;
  const char* file;    // to be read
  const char* victim;  // to be changed
  std::function<void(const path&, const MeshData&)> write;
};

const std::vector<Format>& formats() {
  using namespace testing_io;
  static const auto gmsh_2 = [](bool binary) {
    return [binary](const path& f, const MeshData& m) { write_gmsh_2(f, m, binary); };
  };
  static const auto gmsh_4 = [](bool binary) {
    return [binary](const path& f, const MeshData& m) { write_gmsh_4(f, m, binary); };
  };
  static const auto stl = [](bool binary) {
    return [binary](const path& f, const MeshData& m) { write_stl(f, m, binary); };
  };
  static const auto ply = [](bool binary) {
    return [binary](const path& f, const MeshData& m) { write_ply(f, m, binary); };
  };
  static const std::vector<Format> all{{"gmsh_2_text", "box.msh", "box.msh", gmsh_2(false)},
                                       {"gmsh_2_binary", "box.msh", "box.msh", gmsh_2(true)},
                                       {"gmsh_4_text", "box.msh", "box.msh", gmsh_4(false)},
                                       {"gmsh_4_binary", "box.msh", "box.msh", gmsh_4(true)},
                                       {"opencarp_points", "box.pts", "box.pts", write_opencarp},
                                       {"opencarp_elements", "box.pts", "box.elem", write_opencarp},
                                       {"opencarp_fibres", "box.pts", "box.lon", write_opencarp},
                                       {"stl_text", "box.stl", "box.stl", stl(false)},
                                       {"stl_binary", "box.stl", "box.stl", stl(true)},
                                       {"off", "box.off", "box.off", write_off},
                                       {"obj", "box.obj", "box.obj", write_obj},
                                       {"ply_text", "box.ply", "box.ply", ply(false)},
                                       {"ply_binary", "box.ply", "box.ply", ply(true)}};
  return all;
}

MeshData box() {
  MeshData out = testing_io::data_of(testing::labelled_cube(1));
  out.tet_fields["fibre"] = Matrix::Ones(3, out.tets.cols());
  out.surface_names = {{1, "endo"}, {2, "epi"}};
  return out;
}

std::vector<std::string> words() {
  std::vector<std::string> out{"$MeshFormat\n",
                               "$Nodes\n",
                               "$EndNodes\n",
                               "$Elements\n",
                               "$ElementData\n",
                               "$Entities\n",
                               "4.1 1 8\n",
                               "2.2 0 8\n",
                               "Tt ",
                               "Tr ",
                               "solid ",
                               "facet ",
                               "endfacet\n",
                               "vertex ",
                               "OFF\n",
                               "v ",
                               "f ",
                               "1/2/3 ",
                               "ply\n",
                               "element vertex ",
                               "element face ",
                               "end_header\n",
                               "property list uchar int vertex_indices\n",
                               "format binary_big_endian 1.0\n",
                               " ",
                               "\n",
                               "\r\n",
                               "-",
                               "#"};
  out.emplace_back(4, '\0');
  out.emplace_back(8, '\xFF');
  return out;
}

class MeshFuzz : public ::testing::TestWithParam<Format> {};

// A hundred and four thousand in all: each is a mesh, then made valid, or refused with a message.
TEST_P(MeshFuzz, IsAMeshOrRefused) {
  const TemporaryFolder folder;
  const path file = folder.path / GetParam().file;
  GetParam().write(file, box());
  expect_read_or_refused(folder.path / GetParam().victim, words(), 8000, [&] {
    MeshData data = read_mesh_data(file);
    if (data.tets.cols() > 0)
      assemble(data, {data}, 1);
    else
      make_closed_surface(data);
  });
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshFuzz, ::testing::ValuesIn(formats()),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace polyaffine
