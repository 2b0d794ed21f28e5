#pragma once

#include <utility>
#include <vector>

#include <polyaffine/core/archive.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

template <class Archive>
void archive(Archive& a, LabelledTriangles& x) {
  a(x.triangles, x.labels);
}

/// Reading checks the mesh as its construction does.
template <class Archive>
void archive(Archive& a, TetMesh& mesh) {
  Points points = mesh.points();
  Tets tets = mesh.tets();
  std::vector<int> regions = mesh.regions();
  LabelledTriangles surface{mesh.boundary(), mesh.boundary_labels()};
  a(points, tets, regions, surface);
  if constexpr (Archive::kReading) {
    if (std::ssize(surface.labels) != surface.triangles.cols())
      a.refuse("found " + std::to_string(surface.labels.size()) + " labels of " +
               std::to_string(surface.triangles.cols()) + " triangles, expected as many");
    try {
      mesh = TetMesh(std::move(points), std::move(tets), std::move(regions), surface);
    } catch (const InputError& error) {
      a.refuse(error.what());
    }
  }
}

}  // namespace polyaffine
