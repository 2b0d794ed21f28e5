#include "biventricle_mesh.hpp"

#include <string>

#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/quality.hpp>
#include <polyaffine/mesh/triangle_adjacency.hpp>

#ifdef CARDIAC_WITH_CGAL
#include <polyaffine/meshing/implicit_domain.hpp>
#endif

namespace cardiac::app {

using polyaffine::InputError;
using polyaffine::TetMesh;

#ifdef CARDIAC_WITH_CGAL
namespace {

constexpr double kSmallestDihedralDeg = 8;
// Where the two walls meet some sizes leave parts that touch only in a point or an edge; a slightly smaller
// size does not.
constexpr int kTrials = 8;
constexpr double kSmaller = 0.97;

bool manifold(const TetMesh& mesh) {
  const polyaffine::TriangleAdjacency adjacency = polyaffine::triangle_adjacency(mesh.boundary());
  return adjacency.crowded.empty() && polyaffine::pinched_vertex(mesh.boundary(), adjacency.across) < 0;
}

TetMesh with_regions(const IdealisedBiventricle& shape, const TetMesh& mesh) {
  std::vector<int> region;
  region.reserve(mesh.num_tets());
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
  for (int trial = 0; trial < kTrials; ++trial, size_mm *= kSmaller) {
    const TetMesh mesh = mesh_implicit_domain(domain, polyaffine::sizes_for_edge(size_mm));
    if (manifold(mesh) && polyaffine::mesh_quality(mesh).min_dihedral_deg >= kSmallestDihedralDeg)
      return with_regions(shape, mesh);
  }
  throw polyaffine::ComputationError(
      "meshing: found flat tets or parts that touch without a common face in " + std::to_string(kTrials) +
      " trials, the last with a size of " + std::to_string(size_mm / kSmaller) + " mm; try a smaller size");
}
#else
TetMesh mesh_biventricle(const IdealisedBiventricle&, double) {
  throw InputError(
      "meshing a biventricle: this build was made without CGAL (CMake option POLYAFFINE_WITH_CGAL)");
}
#endif

}  // namespace cardiac::app
