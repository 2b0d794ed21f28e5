#include "cardiac/anatomy/heart_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/anatomy/recognise_surfaces.hpp>
#include <cardiac/core/units.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/mesh/triangle_adjacency.hpp>

namespace cardiac {
namespace {

using polyaffine::InputError;
using polyaffine::TetMesh;
using polyaffine::Triangles;
using Strings = std::vector<std::string>;

constexpr double kLeastRoundness = 0.002;  // V/A^1.5 of a cavity; a sphere has 0.09, a lid next to nothing

const char* name_of(int label) {
  constexpr std::array names{"none", "endocardium", "epicardium", "base", "right endocardium"};
  return names.at(label);
}

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
    text += (text.empty() ? "" : ", ") + std::to_string(n) + " is " + name_of(out[n]);
  }
  notes.push_back("labels whose numbers are not known take their meaning from the shape: " + text);
  return out;
}

/// The canonical label of each boundary triangle, from the file's numbers.
std::vector<int> canonical(const TetMesh& mesh, const std::map<int, std::string>& names,
                           const SurfaceLabelMap& map, Strings& notes) {
  std::set<int> numbers(mesh.boundary_labels().begin(), mesh.boundary_labels().end());
  numbers.erase(TetMesh::kUnlabelled);
  std::map<int, int> label_of = heart_labels(numbers, names, map);
  if (label_of.empty()) {
    RecognisedSurfaces shape = recognise_surfaces(mesh);
    notes.insert(notes.end(), shape.notes.begin(), shape.notes.end());
    if (numbers.empty()) return shape.labels;
    label_of = by_shape(mesh, shape.labels, notes);
  }
  std::vector<int> out;
  std::map<int, int> unknown;
  for (const int n : mesh.boundary_labels()) {
    const auto label = label_of.find(n);
    out.push_back(label == label_of.end() ? TetMesh::kUnlabelled : label->second);
    if (label == label_of.end() && n != TetMesh::kUnlabelled) ++unknown[n];
  }
  for (const auto& [n, count] : unknown)
    notes.push_back("label " + std::to_string(n) + " (" + std::to_string(count) +
                    " triangles) is no surface of a ventricle: left unlabelled");
  return out;
}

/// Volume that the surface with a label surrounds with a cone over its rims, mm³, positive for the outside of
/// a body.
double surrounded(const TetMesh& mesh, int label) {
  const Triangles surface = mesh.surface({label});
  Vec3 tip = Vec3::Zero();
  const auto rim = polyaffine::triangle_adjacency(surface).open;
  for (const auto& [a, b] : rim)
    tip += (mesh.points().col(a) + mesh.points().col(b)) / (2.0 * static_cast<double>(rim.size()));
  double sum = 0;
  for (const auto& t : surface.colwise()) {
    const Vec3 a = mesh.points().col(t[0]) - tip, b = mesh.points().col(t[1]) - tip;
    sum += a.dot(b.cross(mesh.points().col(t[2]) - tip)) / 6;
  }
  return sum;
}

[[noreturn]] void fail_contradiction(int label, const std::string& found) {
  throw InputError(std::string("mesh: the surface labelled ") + name_of(label) + ' ' + found +
                   "; are labels swapped?");
}

/// Volume of a cavity, mm³.
double check_cavity(const TetMesh& mesh, int label) {
  const polyaffine::EnclosedVolume cavity(mesh, {label});
  const double volume = cavity.value(mesh.points()), area = polyaffine::surface_area(mesh, {label});
  if (cavity.rims().empty()) fail_contradiction(label, "is closed, expected an opening at the base");
  if (volume < kLeastRoundness * std::pow(area, 1.5))
    fail_contradiction(label, "surrounds no cavity: found " + number(volume / mm3_per_mL) + " mL behind " +
                                  number(area / 100) + " cm², expected a cavity inside the wall");
  return volume;
}

void check_rims(const TetMesh& mesh, int label) {
  const std::vector<int> base = mesh.surface_points({kBase});
  const auto rims = polyaffine::rim_loops(mesh.surface({label}));
  for (const auto& rim : rims)
    for (const int p : rim)
      if (!std::ranges::binary_search(base, p)) {
        const Vec3 x = mesh.points().col(p);
        throw InputError("open cavity: found a rim of the " + std::string(name_of(label)) +
                         " off the base at (" + number(x.x()) + ", " + number(x.y()) + ", " + number(x.z()) +
                         ") mm, expected the endocardium to reach the base all round");
      }
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

}  // namespace

void check_heart_surfaces(const TetMesh& mesh) {
  std::vector<int> endocardia{kEndocardium};
  if (mesh.surface({kRvEndocardium}).cols() > 0) endocardia.push_back(kRvEndocardium);
  double cavities = 0;
  for (const int label : endocardia) cavities += check_cavity(mesh, label);
  if (const double outside = surrounded(mesh, kEpicardium); outside < cavities)
    fail_contradiction(kEpicardium, "does not surround the cavities: found " + number(outside / mm3_per_mL) +
                                        " mL within it, expected more than their " +
                                        number(cavities / mm3_per_mL));
  for (const int label : endocardia) check_rims(mesh, label);
}

HeartMesh make_heart_mesh(polyaffine::MeshData volume, const polyaffine::MeshData* surface,
                          const HeartMeshOptions& options) {
  std::vector<std::string> fibres = keep_fibre_fields(volume, options.fibre_arrays, options.all_fields);
  const polyaffine::MeshData& triangles = surface == nullptr ? volume : *surface;
  if (surface != nullptr && surface->triangles.cols() == 0)
    throw InputError(surface->source.string() + ": found no triangles, expected labelled surface triangles");
  const bool wanted = surface != nullptr || !options.label_array.empty();
  const std::string field = polyaffine::label_field(triangles, options.label_array);
  const polyaffine::SurfaceData labels = wanted || !field.empty()
                                             ? polyaffine::labelled_surface(triangles, options.label_array)
                                             : polyaffine::SurfaceData{triangles};
  HeartMesh out{polyaffine::assemble(volume, labels, options.mm_per_unit), std::move(fibres), {}};
  try {
    const auto names = field == "physical" ? triangles.surface_names : std::map<int, std::string>{};
    std::vector<int> boundary = canonical(out.file.mesh, names, options.labels, out.file.notes);
    split_cavities(out.file.mesh, boundary, out.file.notes);
    out.file.mesh = out.file.mesh.with_labels(std::move(boundary));
    check_heart_surfaces(out.file.mesh);
    const std::string size = check_wall_size(
        out.file.mesh.volume(), options.told_mm_per_unit.value_or(options.mm_per_unit), options.size);
    if (!size.empty()) out.warnings.push_back(size);
  } catch (const InputError& error) {
    throw InputError(triangles.source.string() + ": " + error.what());
  }
  warn_of_swapped_ventricles(out.file.mesh, out.warnings);
  return out;
}

}  // namespace cardiac
