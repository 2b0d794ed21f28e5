#include "mesh_report.hpp"

#include <iostream>

#include <cardiac/core/units.hpp>
#include <polyaffine/mesh/quality.hpp>
#include <polyaffine/mesh/surface.hpp>

namespace cardiac::app {

using polyaffine::TetMesh;

void print_counts(const TetMesh& mesh, const std::vector<NamedSurface>& surfaces) {
  std::cout << "tets                 " << mesh.num_tets() << "\nvertices             " << mesh.num_points()
            << "\nboundary triangles   " << mesh.boundary().cols();
  const char* between = " (";
  for (const NamedSurface& s : surfaces) {
    std::cout << between << s.name << ' ' << mesh.surface({s.label}).cols();
    between = ", ";
  }
  std::cout << ")\n";
}

void print_quality(const TetMesh& mesh) {
  const auto quality = polyaffine::mesh_quality(mesh);
  std::cout << "edge_length_mm       " << quality.min_edge_mm << " to " << quality.max_edge_mm << ", mean "
            << quality.mean_edge_mm << "\ndihedral_angle_deg   " << quality.min_dihedral_deg << " to "
            << quality.max_dihedral_deg << "\nradius_ratio         " << quality.min_radius_ratio
            << " at worst, mean " << quality.mean_radius_ratio << "\naspect_ratio         "
            << quality.max_aspect_ratio << " at worst, mean " << quality.mean_aspect_ratio << '\n';
}

double cavity_mL(const TetMesh& mesh, int label) {
  return polyaffine::EnclosedVolume(mesh, {label}).value(mesh.points()) / mm3_per_mL;
}

}  // namespace cardiac::app
