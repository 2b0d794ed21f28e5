#include "bench_hearts.hpp"

#include <array>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>

#ifdef CARDIAC_WITH_VTK
#include <polyaffine/vtk/write.hpp>
#endif

#include "biventricle_mesh.hpp"
#include "example_data.hpp"
#include "load_mesh.hpp"
#include "surface_mesh.hpp"

namespace cardiac::app {
namespace {

struct HeartFile {
  const char *heart, *mesh, *surface, *unit;
  bool two_ventricles, of_project;
};

constexpr std::array<HeartFile, 5> kFiles{{{"biv", "meshes/healthy_biv_coarse.vtu", "", "mm", true, true},
                                           {"lv_real", "data/hearts/lv_1260.msh", "", "mm", false, false},
                                           {"lv_arostica", "data/arostica2025/lv_volume.vtu",
                                            "data/arostica2025/lv_surface.vtu", "m", false, false},
                                           {"biv_arostica", "data/arostica2025/biv_volume.vtu",
                                            "data/arostica2025/biv_surface.vtu", "m", true, false},
                                           {"papillary", "field/papillary/pap.msh", "", "mm", false, false}}};

// Edges of a coarse mesh over half the mean thickness of the wall, the longest first; and of the drawn two
// ventricles, mm, whose right wall lets them be no longer.
constexpr std::array kEdges{3.0, 2.0};
constexpr std::array kDrawn_mm{11.0, 10.0, 9.0, 8.0};

// The closed surface of a mesh with its labels, and only the points that are on it.
polyaffine::MeshData surface_of(const polyaffine::TetMesh& mesh, const std::string& name) {
  polyaffine::MeshData out;
  out.source = name;
  std::map<int, int> number;
  std::vector<int> points;
  out.triangles = mesh.boundary();
  for (int& vertex : out.triangles.reshaped()) {
    const auto [at, is_new] = number.try_emplace(vertex, static_cast<int>(points.size()));
    if (is_new) points.push_back(vertex);
    vertex = at->second;
  }
  out.points = mesh.points()(Eigen::all, points);
  const std::vector<int>& labels = mesh.boundary_labels();
  out.triangle_fields["surface"] =
      Eigen::Map<const Eigen::RowVectorXi>(labels.data(), std::ssize(labels)).cast<double>();
  return out;
}

void keep([[maybe_unused]] const std::filesystem::path& file,
          [[maybe_unused]] const polyaffine::TetMesh& mesh) {
#ifdef CARDIAC_WITH_VTK
  polyaffine::write_vtu(file, mesh);
#else
  throw polyaffine::InputError(file.string() + ": this build writes no .vtu files");
#endif
}

// The first mesh that can be made, of lengths from the longest down: shorter edges make more tets.
template <class Lengths>
std::optional<polyaffine::TetMesh> coarsest(const Lengths& lengths, const std::string& heart, int most_tets,
                                            const std::function<polyaffine::TetMesh(double)>& make) {
  std::string why;
  for (const double length : lengths) {
    try {
      polyaffine::TetMesh out = make(length);
      if (out.num_tets() < most_tets) return out;
      why = "it would have " + std::to_string(out.num_tets()) + " tets, the mesh itself has " +
            std::to_string(most_tets);
      break;
    } catch (const std::runtime_error& error) {
      why = error.what();
    }
  }
  std::cerr << "cardiac bench: no coarse mesh of " << heart << ": " << why << '\n';
  return std::nullopt;
}

std::optional<polyaffine::TetMesh> coarse_mesh(const polyaffine::TetMesh& mesh, const std::string& heart,
                                               bool is_drawn) {
  if (is_drawn)
    return coarsest(kDrawn_mm, heart, mesh.num_tets(),
                    [](double edge) { return mesh_biventricle(human_biventricle(), edge); });
  const polyaffine::MeshData surface = surface_of(mesh, heart);
  const double half_wall =
      mesh.volume() / polyaffine::triangle_areas(surface.points, surface.triangles).sum();
  return coarsest(kEdges, heart, mesh.num_tets(),
                  [&](double factor) { return fill_surface(surface, {}, factor * half_wall).file.mesh; });
}

}  // namespace

std::filesystem::path heart_folder(const std::filesystem::path& given) {
  if (!given.empty()) return given;
  const char* told = std::getenv("CARDIAC_HEARTS");
  return told != nullptr ? told : "../shared";
}

HeartSource heart_source(const std::filesystem::path& folder, const std::filesystem::path& made) {
  const auto file_of = [](const std::string& heart) {
    for (const HeartFile& file : kFiles)
      if (heart == file.heart) return file;
    throw polyaffine::InputError("bench: unknown heart " + heart);
  };
  const auto load = [](const HeartFile& file, const std::filesystem::path& mesh,
                       const std::filesystem::path& surface, const std::string& unit,
                       const std::vector<std::string>& settings) {
    std::vector<std::string> all{"mesh.file=" + std::filesystem::absolute(mesh).string(),
                                 "mesh.length_unit=" + unit};
    if (!surface.empty()) all.push_back("mesh.surface_file=" + std::filesystem::absolute(surface).string());
    all.insert(all.end(), settings.begin(), settings.end());
    return load_input(
        given_or_example(file.two_ventricles ? "protocols/healthy_biv.toml" : "protocols/healthy_lv.toml"),
        all);
  };
  const auto told = std::make_shared<std::set<std::string>>(),
             without = std::make_shared<std::set<std::string>>();
  const HeartSource::Input input = [=](const std::string& heart,
                                       const std::vector<std::string>& settings) -> std::optional<Protocol> {
    const HeartFile file = file_of(heart);
    const std::filesystem::path mesh = file.of_project ? given_or_example(file.mesh) : folder / file.mesh;
    if (!std::filesystem::is_regular_file(mesh)) {
      if (told->insert(heart).second)
        std::cerr << "cardiac bench: left out " << heart << ": no file " << mesh.string()
                  << " (--hearts, CARDIAC_HEARTS)\n";
      return std::nullopt;
    }
    const std::string surface = file.surface;
    return load(file, mesh, surface.empty() ? std::filesystem::path() : folder / surface, file.unit,
                settings);
  };
  const HeartSource::Input coarse = [=](const std::string& heart,
                                        const std::vector<std::string>& settings) -> std::optional<Protocol> {
    const std::filesystem::path file = made / (heart + "_coarse.vtu");
    if (!std::filesystem::is_regular_file(file)) {
      const auto fine = input(heart, settings);
      if (!fine || without->contains(heart)) return std::nullopt;
      const auto mesh = coarse_mesh(fine->heart->mesh, heart, file_of(heart).of_project);
      if (!mesh) {
        without->insert(heart);
        return std::nullopt;
      }
      polyaffine::make_folder(made);
      keep(file, *mesh);
    }
    return load(file_of(heart), file, {}, "mm", settings);
  };
  return {input, coarse};
}

}  // namespace cardiac::app
