#include "surface_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include <cardiac/anatomy/bare_ring.hpp>
#include <cardiac/anatomy/check_surfaces.hpp>
#include <cardiac/anatomy/recognise_surfaces.hpp>
#include <cardiac/anatomy/triangle_labels.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/mesh/triangle_adjacency.hpp>
#include <polyaffine/mesh_io/closed_surface.hpp>
#include <polyaffine/mesh_io/file_extension.hpp>

#ifdef CARDIAC_WITH_CGAL
#include <polyaffine/meshing/nearest_triangles.hpp>
#include <polyaffine/meshing/polyhedral_domain.hpp>
#include <polyaffine/meshing/thickness.hpp>
#endif

namespace cardiac::app {

using polyaffine::InputError;

bool is_surface(const polyaffine::MeshData& data) {
  constexpr std::array kExtensions{".stl", ".off", ".obj", ".ply", ".vtp"};
  const std::string extension = polyaffine::lower_extension(data.source);
  if (std::ranges::find(kExtensions, extension) != kExtensions.end()) return true;
  return (extension == ".vtk" || extension == ".vtu") && data.tets.cols() == 0 && data.triangles.cols() > 0;
}

#ifdef CARDIAC_WITH_CGAL
namespace {

// Where the labels of the triangles are kept while the surface is repaired and filled.
constexpr const char* kField = "surface";

// Leaves out the triangles of labels without a meaning of which one has an edge with two others: caps that
// close a cavity, or the same triangles under a second label.
void drop_caps(polyaffine::MeshData& data, TriangleLabels& labels) {
  const std::vector<int> numbers = polyaffine::labelled_surface(data, labels.array).labels;
  const auto crowded = polyaffine::triangle_adjacency(data.triangles).crowded;
  const std::set<std::array<int, 2>> edges(crowded.begin(), crowded.end());
  std::map<int, int> caps;
  for (Eigen::Index t = 0; t < data.triangles.cols(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(data.triangles(k, t), data.triangles((k + 1) % 3, t));
      if (labels.labels[t] == polyaffine::TetMesh::kUnlabelled && edges.contains({a, b}))
        caps[numbers[t]] = 0;
    }
  if (caps.empty()) return;
  std::vector<int> kept, kept_labels;
  for (int t = 0; t < static_cast<int>(data.triangles.cols()); ++t) {
    const bool unlabelled = labels.labels[t] == polyaffine::TetMesh::kUnlabelled;
    if (unlabelled && caps.contains(numbers[t])) continue;
    kept.push_back(t);
    kept_labels.push_back(labels.labels[t]);
  }
  data.triangles = polyaffine::Triangles(data.triangles(Eigen::all, kept));
  for (auto& [name, field] : data.triangle_fields) field = polyaffine::Matrix(field(Eigen::all, kept));
  labels.labels = std::move(kept_labels);
}

// The closed surface, its labels in kField; as far as they are known they are checked.
TriangleLabels prepare(polyaffine::MeshData& data, const HeartMeshOptions& options) {
  TriangleLabels labels = read_triangle_labels(data, options.label_array, options.labels);
  if (labels.known) drop_caps(data, labels);
  if (!labels.array.empty())
    data.triangle_fields[kField] =
        Eigen::Map<const Eigen::RowVectorXi>(labels.labels.data(), data.triangles.cols()).cast<double>();
  polyaffine::make_closed_surface(data);
  if (!labels.array.empty()) labels.labels = polyaffine::labelled_surface(data, kField).labels;
  try {
    if (!labels.base_missing.empty()) {
      check_bare_rings(data.points, data.triangles, labels.labels);
      throw InputError(labels.base_missing);
    }
    if (!labels.known) {
      check_tapered_rims(data.points, data.triangles);
      return labels;
    }
    check_heart_surfaces(data.points, data.triangles, labels.labels);
  } catch (const InputError& error) {
    throw InputError(data.source.string() + ": " + error.what());
  }
  return labels;
}

// Gives each boundary triangle of the filled surface the label of the nearest one of the file.
void carry_labels(const polyaffine::MeshData& surface, const TriangleLabels& labels,
                  const polyaffine::TetMesh& mesh, polyaffine::MeshData& filled) {
  if (labels.array.empty()) return;
  filled.triangles = mesh.boundary();
  polyaffine::Points centroids(3, filled.triangles.cols());
  for (Eigen::Index f = 0; f < centroids.cols(); ++f)
    centroids.col(f) = mesh.points()(Eigen::all, filled.triangles.col(f)).rowwise().mean();
  const auto nearest = polyaffine::nearest_triangles(surface.points, surface.triangles, centroids);
  polyaffine::Matrix& field = filled.triangle_fields[kField] = polyaffine::Matrix(1, centroids.cols());
  for (Eigen::Index f = 0; f < centroids.cols(); ++f) field(0, f) = labels.labels[nearest[f]];
  filled.notes.push_back("labels \"" + labels.array + "\" of the surface carried over");
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

HeartMesh fill_surface([[maybe_unused]] polyaffine::MeshData data,
                       [[maybe_unused]] const HeartMeshOptions& options,
                       [[maybe_unused]] std::optional<double> size_mm) {
#ifdef CARDIAC_WITH_CGAL
  data.points *= options.mm_per_unit;
  const TriangleLabels labels = prepare(data, options);
  if (size_mm && !(*size_mm > 0 && std::isfinite(*size_mm)))
    throw InputError("--size: found " + std::to_string(*size_mm) + " mm, expected a positive length");
  const double volume = polyaffine::EnclosedVolume(data.triangles).value(data.points);
  check_wall_size(std::abs(volume), options.mm_per_unit, options.size);
  const double area = polyaffine::triangle_areas(data.points, data.triangles).sum();
  const double edge = size_mm.value_or(-volume / area);
  polyaffine::MeshData filled;
  filled.source = data.source;
  filled.notes = data.notes;
  filled.notes.insert(filled.notes.end(), labels.notes.begin(), labels.notes.end());
  filled.notes.push_back("closed surface of " + std::to_string(data.triangles.cols()) +
                         " triangles filled with tetrahedra of edges of about " + std::to_string(edge) +
                         " mm" + thin_part(data, edge));
  try {
    const polyaffine::TetMesh mesh =
        polyaffine::mesh_polyhedral_domain(data.points, data.triangles, polyaffine::sizes_for_edge(edge));
    filled.points = mesh.points();
    filled.tets = mesh.tets();
    carry_labels(data, labels, mesh, filled);
  } catch (const InputError& error) {
    throw InputError(data.source.string() + ": " + error.what());
  } catch (const polyaffine::ComputationError& error) {
    throw polyaffine::ComputationError(data.source.string() +
                                       ": the surface is sound, but could not be filled: " + error.what() +
                                       " (--size)");
  }
  HeartMeshOptions in_mm = options;
  in_mm.mm_per_unit = 1;
  in_mm.labels = {};
  in_mm.label_array = labels.array.empty() ? "" : kField;
  in_mm.told_mm_per_unit = options.mm_per_unit;
  return make_heart_mesh(std::move(filled), nullptr, in_mm);
#else
  throw InputError(data.source.string() +
                   ": this build fills no surfaces (CMake option POLYAFFINE_WITH_CGAL)");
#endif
}

}  // namespace cardiac::app
