#pragma once

#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac::app {

struct NamedSurface {
  int label;
  const char* name;
};

/// Lines of a mesh's report: tets, vertices, and triangles of the boundary by surface.
void print_counts(const polyaffine::TetMesh& mesh, const std::vector<NamedSurface>& surfaces);
/// Lines of a mesh's report: edges, dihedral angles, radius and aspect ratios.
void print_quality(const polyaffine::TetMesh& mesh);

/// Volume that the labelled surface encloses, closed over its rim.
double cavity_mL(const polyaffine::TetMesh& mesh, int label);

}  // namespace cardiac::app
