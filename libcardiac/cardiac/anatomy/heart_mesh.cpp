#include "cardiac/anatomy/heart_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <cardiac/anatomy/bare_ring.hpp>
#include <cardiac/anatomy/check_surfaces.hpp>
#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/recognise_surfaces.hpp>
#include <cardiac/anatomy/triangle_labels.hpp>
#include <cardiac/core/units.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>

namespace cardiac {
namespace {

using polyaffine::InputError;
using polyaffine::TetMesh;
using Strings = std::vector<std::string>;

std::string number(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  return out.str();
}

/// What each number of the boundary is, by most of its area.
std::map<int, int> by_shape(const TetMesh& mesh, const std::vector<int>& recognised, Strings& notes) {
  const polyaffine::Vector area = polyaffine::triangle_areas(mesh.points(), mesh.boundary());
  std::map<int, std::map<int, double>> votes;
  for (std::size_t f = 0; f < recognised.size(); ++f)
    if (const int n = mesh.boundary_labels()[f]; n != TetMesh::kUnlabelled)
      votes[n][recognised[f]] += area[static_cast<Eigen::Index>(f)];
  std::map<int, int> out;
  std::string text;
  for (const auto& [n, shares] : votes) {
    out[n] = std::ranges::max_element(shares, {}, [](const auto& share) { return share.second; })->first;
    text += (text.empty() ? "" : ", ") + std::to_string(n) + " is " + surface_title(out[n]);
  }
  notes.push_back("labels whose numbers are not known take their meaning from the shape: " + text);
  return out;
}

/// Fails when none of the labelled triangles of a surface is on the boundary.
void check_on_boundary(const TetMesh& mesh, const TriangleLabels& given) {
  for (const int label : std::set<int>(given.labels.begin(), given.labels.end()))
    if (label != TetMesh::kUnlabelled && !given.optional.contains(label) && mesh.surface({label}).cols() == 0)
      throw InputError("mesh: found the " + std::to_string(std::ranges::count(given.labels, label)) +
                       " triangles of the surface " + surface_title(label) +
                       " between two tets, expected them on the boundary of the wall");
}

/// The canonical label of each boundary triangle.
std::vector<int> canonical(const TetMesh& mesh, const TriangleLabels& given, bool rest_is_base,
                           Strings& notes) {
  std::vector<int> out = mesh.boundary_labels();
  if (given.known) {
    check_on_boundary(mesh, given);
    if (!given.base_missing.empty()) {
      check_bare_rings(mesh.points(), mesh.boundary(), out);
      throw InputError(given.base_missing);
    }
    if (rest_is_base) std::ranges::replace(out, TetMesh::kUnlabelled, kBase);
    return out;
  }
  RecognisedSurfaces shape = recognise_surfaces(mesh);
  notes.insert(notes.end(), shape.notes.begin(), shape.notes.end());
  if (std::ranges::all_of(out, [](int n) { return n == TetMesh::kUnlabelled; })) return shape.labels;
  const std::map<int, int> label_of = by_shape(mesh, shape.labels, notes);
  for (int& n : out) n = n == TetMesh::kUnlabelled ? n : label_of.at(n);
  return out;
}

void warn_of_swapped_ventricles(const TetMesh& mesh, Strings& warnings) {
  if (mesh.surface({kRvEndocardium}).cols() == 0) return;
  const auto roundness = [&](int label) {
    return polyaffine::EnclosedVolume(mesh, {label}).value(mesh.points()) /
           std::pow(polyaffine::surface_area(mesh, {label}), 1.5);
  };
  if (const double left = roundness(kEndocardium), right = roundness(kRvEndocardium); left < right)
    warnings.push_back("the left cavity is less round than the right one (V/A^1.5 " + number(left) +
                       " against " + number(right) + "): are their labels swapped?");
}

HeartMesh build(polyaffine::MeshData volume, polyaffine::MeshData* surface, const HeartMeshOptions& options) {
  polyaffine::MeshData& triangles = surface == nullptr ? volume : *surface;
  if (surface != nullptr && surface->triangles.cols() == 0)
    throw InputError(surface->source.string() + ": found no triangles, expected labelled surface triangles");
  keep_regions(volume, options.regions);
  const TriangleLabels labels = read_triangle_labels(triangles, options.label_array, options.labels);
  if (surface != nullptr && labels.array.empty()) polyaffine::labelled_surface(*surface, "");  // says why
  std::vector<std::string> fibres = keep_fibre_fields(volume, options.fibre_arrays, options.all_fields);
  polyaffine::SurfaceData given{triangles, labels.labels, labels.optional, labels.notes};
  if (!options.regions.wanted.empty()) given.optional.insert(labels.labels.begin(), labels.labels.end());
  HeartMesh out{polyaffine::assemble(volume, given, options.mm_per_unit), std::move(fibres), {}};
  TetMesh& mesh = out.file.mesh;
  try {
    std::vector<int> boundary = canonical(mesh, labels, options.labels.rest_is_base, out.file.notes);
    split_cavities(mesh, boundary, out.file.notes);
    mesh = mesh.with_labels(std::move(boundary));
    check_heart_surfaces(mesh.points(), mesh.boundary(), mesh.boundary_labels());
    const std::string size =
        check_wall_size(mesh.volume(), options.told_mm_per_unit.value_or(options.mm_per_unit), options.size);
    if (!size.empty()) out.warnings.push_back(size);
  } catch (const InputError& error) {
    throw InputError(triangles.source.string() + ": " + error.what());
  }
  warn_of_swapped_ventricles(mesh, out.warnings);
  return out;
}

}  // namespace

HeartMesh make_heart_mesh(polyaffine::MeshData volume, polyaffine::MeshData* surface,
                          const HeartMeshOptions& options) {
  const std::string regions =
      options.regions.wanted.empty() ? regions_in_words(volume, options.regions.array) : "";
  try {
    return build(std::move(volume), surface, options);
  } catch (const InputError& error) {
    if (regions.empty()) throw;
    throw InputError(error.what() + ("; the tets have the regions " + regions) +
                     ": mesh.region, or --region of cardiac mesh import, keeps those of the wall");
  }
}

}  // namespace cardiac
