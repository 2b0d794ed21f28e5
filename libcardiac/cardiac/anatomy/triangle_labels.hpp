#pragma once

#include <cardiac/anatomy/surface_names.hpp>
#include <polyaffine/mesh_io/label_fields.hpp>

namespace cardiac {

/// Labels of the triangles of a file, understood as far as they can be before there is a mesh.
struct TriangleLabels {
  std::string array;        ///< where they come from; empty: the triangles have none
  std::vector<int> labels;  ///< of each triangle; 0 is none
  bool known = false;       ///< labels are kEndocardium, kEpicardium, kBase, kRvEndocardium; else the file's
  std::set<int> optional;   ///< labels whose triangles may be no faces of the wall (polyaffine::SurfaceData)
  std::string base_missing{};      ///< what is wrong when there are labels of all surfaces but the base
  std::vector<std::string> notes;  ///< what was left out
};

/// Reads the labels of a file from `label_array` (an array of triangles or, failing that, of points; empty:
/// the usual names of triangle arrays, or the point array "class", in which Cobiveco numbers base 1,
/// epicardium 2, left endocardium 3 and right endocardium 4) and gives them their meaning by heart_labels.
/// Triangles of labels with no meaning become unlabelled, with a note. `data` gains the array of triangles
/// that is made from one of points, and for a mesh without triangles those of its boundary.
/// Throws InputError, naming the file, when an array that was named is not there, and as heart_labels; but a
/// missing base, for which the shape may show a reason, is told in base_missing.
TriangleLabels read_triangle_labels(polyaffine::MeshData& data, const std::string& label_array,
                                    const SurfaceLabelMap& map);

}  // namespace cardiac
