#include "surface_mesh.hpp"

#include <array>
#include <cmath>
#include <sstream>

#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/mesh_io/closed_surface.hpp>
#include <polyaffine/mesh_io/label_fields.hpp>

#include "read_heart.hpp"

#ifdef CARDIAC_WITH_CGAL
#include <polyaffine/meshing/nearest_triangles.hpp>
#include <polyaffine/meshing/polyhedral_domain.hpp>
#include <polyaffine/meshing/thickness.hpp>
#endif

namespace cardiac::app {

using polyaffine::InputError;

bool is_surface_file(const std::filesystem::path& file) {
  constexpr std::array kExtensions{".stl", ".off", ".obj", ".ply", ".vtp"};
  return std::ranges::find(kExtensions, file.extension().string()) != kExtensions.end();
}

#ifdef CARDIAC_WITH_CGAL
namespace {

// Gives each boundary triangle of the filled surface the label of the nearest one of the file, in the field
// of the same name; nothing where the file has no labels.
void carry_labels(const polyaffine::MeshData& surface, const std::string& wanted,
                  const polyaffine::TetMesh& mesh, polyaffine::MeshData& filled) {
  const std::string name = polyaffine::label_field(surface, wanted);
  if (name.empty()) return;
  const std::vector<int> labels = polyaffine::labelled_surface(surface, wanted).labels;
  filled.triangles = mesh.boundary();
  polyaffine::Points centroids(3, filled.triangles.cols());
  for (Eigen::Index f = 0; f < centroids.cols(); ++f)
    centroids.col(f) = mesh.points()(Eigen::all, filled.triangles.col(f)).rowwise().mean();
  const auto nearest = polyaffine::nearest_triangles(surface.points, surface.triangles, centroids);
  polyaffine::Matrix& field = filled.triangle_fields[name] = polyaffine::Matrix(1, centroids.cols());
  for (Eigen::Index f = 0; f < centroids.cols(); ++f) field(0, f) = labels[nearest[f]];
  filled.surface_names = surface.surface_names;
  filled.notes.push_back("labels \"" + name + "\" of the surface carried over");
}

// What a note says of a wall that needs shorter edges somewhere; empty where it does not.
std::string thin_part(const polyaffine::MeshData& surface, double edge_mm) {
  const polyaffine::ThinPlace thin = polyaffine::thinnest_place(surface.points, surface.triangles);
  if (thin.thickness_mm > edge_mm) return "";
  std::ostringstream text;
  text.precision(3);
  text << ", shorter where the wall is thin (" << thin.thickness_mm << " mm near (" << thin.place.x() << ", "
       << thin.place.y() << ", " << thin.place.z() << ") mm)";
  return text.str();
}

}  // namespace
#endif

HeartMesh fill_surface(const std::filesystem::path& file, [[maybe_unused]] const HeartMeshOptions& options,
                       [[maybe_unused]] std::optional<double> size_mm) {
#ifdef CARDIAC_WITH_CGAL
  polyaffine::MeshData data = read_any_mesh(file);
  data.points *= options.mm_per_unit;
  polyaffine::make_closed_surface(data);
  if (size_mm && !(*size_mm > 0 && std::isfinite(*size_mm)))
    throw InputError("--size: found " + std::to_string(*size_mm) + " mm, expected a positive length");
  const double volume = polyaffine::EnclosedVolume(data.triangles).value(data.points);
  const double area = polyaffine::triangle_areas(data.points, data.triangles).sum();
  const double edge = size_mm.value_or(-volume / area);
  polyaffine::MeshData filled;
  filled.source = file;
  filled.notes = data.notes;
  filled.notes.push_back("closed surface of " + std::to_string(data.triangles.cols()) +
                         " triangles filled with tetrahedra of edges of about " + std::to_string(edge) +
                         " mm" + thin_part(data, edge));
  try {
    const polyaffine::TetMesh mesh =
        polyaffine::mesh_polyhedral_domain(data.points, data.triangles, polyaffine::sizes_for_edge(edge));
    filled.points = mesh.points();
    filled.tets = mesh.tets();
    carry_labels(data, options.label_array, mesh, filled);
  } catch (const InputError& error) {
    throw InputError(file.string() + ": " + error.what());
  } catch (const polyaffine::ComputationError& error) {
    throw polyaffine::ComputationError(
        file.string() + ": the surface is sound, but could not be filled: " + error.what() + " (--size)");
  }
  HeartMeshOptions in_mm = options;
  in_mm.mm_per_unit = 1;
  return make_heart_mesh(std::move(filled), nullptr, in_mm);
#else
  throw InputError(file.string() + ": this build fills no surfaces (CMake option POLYAFFINE_WITH_CGAL)");
#endif
}

}  // namespace cardiac::app
