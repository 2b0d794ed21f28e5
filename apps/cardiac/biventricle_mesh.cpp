#include "biventricle_mesh.hpp"

#include <string>

#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/quality.hpp>

#ifdef CARDIAC_WITH_CGAL
#include <polyaffine/meshing/implicit_domain.hpp>
#endif

namespace cardiac::app {

using polyaffine::InputError;
using polyaffine::TetMesh;

#ifdef CARDIAC_WITH_CGAL
namespace {

constexpr double kSmallestDihedralDeg = 8;

TetMesh with_regions(const IdealisedBiventricle& shape, const TetMesh& mesh) {
  std::vector<int> region;
  for (int t = 0; t < mesh.num_tets(); ++t) region.push_back(wall_region(shape, mesh.tet_centroid(t)));
  return {mesh.points(), mesh.tets(), region, {mesh.boundary(), mesh.boundary_labels()}};
}

}  // namespace

TetMesh mesh_biventricle(const IdealisedBiventricle& shape, double size_mm) {
  if (!(size_mm > 0) || size_mm > 2 * shape.rv_wall_mm)
    throw InputError("size: found " + std::to_string(size_mm) + " mm, expected more than 0 and at most " +
                     std::to_string(2 * shape.rv_wall_mm) + " mm (twice the right wall)");
  const double on_surface_mm = 0.01 * shape.rv_wall_mm;
  polyaffine::ImplicitDomain domain;
  domain.value = [&](const polyaffine::Vec3& x) { return wall_function(shape, x); };
  domain.centre = {shape.rv_centre_mm / 2, 0, 0};
  domain.radius_mm = 1.3 * shape.lv.epi_long_mm;
  for (const auto& rim : rims(shape, 0.1 * size_mm)) domain.edges.push_back(rim);
  domain.project = [&](const polyaffine::Vec3& x) {
    return project_to_wall_surface(shape, on_surface_mm, x);
  };
  domain.label = [&](const std::array<polyaffine::Vec3, 3>& triangle) {
    return surface_label(shape, on_surface_mm, triangle);
  };
  const TetMesh mesh = mesh_implicit_domain(domain, polyaffine::sizes_for_edge(size_mm));
  const double smallest = polyaffine::mesh_quality(mesh).min_dihedral_deg;
  if (smallest < kSmallestDihedralDeg)
    throw polyaffine::ComputationError("meshing: the smallest dihedral angle is " + std::to_string(smallest) +
                                       " degrees, expected " + std::to_string(kSmallestDihedralDeg) +
                                       " or more; try a slightly different size");
  return with_regions(shape, mesh);
}
#else
TetMesh mesh_biventricle(const IdealisedBiventricle&, double) {
  throw InputError(
      "meshing a biventricle: this build was made without CGAL (CMake option POLYAFFINE_WITH_CGAL)");
}
#endif

}  // namespace cardiac::app
