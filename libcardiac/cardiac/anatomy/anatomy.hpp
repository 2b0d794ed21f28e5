#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/anatomy/segments.hpp>
#include <cardiac/tissue/fibre_axes.hpp>

namespace cardiac {

/// Axes f, s, n at points of a wall with these coordinates.
using FibreFunction =
    std::function<FibreAxes(const VentricularCoordinates& coordinates, const std::vector<int>& tet,
                            const Eigen::Matrix4Xd& barycentric)>;

/// The mesh with its coordinates and segments: what every method starts from.
struct Anatomy {
  polyaffine::TetMesh mesh;
  SurfaceLabels labels;
  std::shared_ptr<const VentricularCoordinates> coordinates;
  std::vector<int> segment;              ///< AHA segment of each tet
  FibreFunction fibres;                  ///< empty: a rule in the ventricular coordinates
  polyaffine::Vector epicardial_weight;  ///< of each vertex, ≥ 0: how firmly it is held; empty: 1
  AnatomyOptions options;                ///< that it was made with; those of a file that was read are lost
};

/// The boundary of the mesh carries the labels kEndocardium, kEpicardium and kBase, with two ventricles also
/// kRvEndocardium. Throws InputError as its coordinates and its segments do.
Anatomy make_anatomy(polyaffine::TetMesh mesh, const AnatomyOptions& options = {}, FibreFunction fibres = {});

}  // namespace cardiac
