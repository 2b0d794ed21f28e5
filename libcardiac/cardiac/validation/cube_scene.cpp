#include "cardiac/validation/cube_scene.hpp"

#include <cmath>
#include <utility>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/geodesic_regions.hpp>
#include <polyaffine/kinematics/region_frames.hpp>

namespace cardiac {

using namespace polyaffine;

CubeScene::CubeScene(TetMesh of)
    : mesh(std::move(of)),
      linear(std::make_shared<LagrangeBasis>(mesh, 1)),
      quadratic(std::make_shared<LagrangeBasis>(mesh, 2)),
      solver(mesh) {}

SurfacePoints CubeScene::face(const LagrangeBasis& basis, int label) const {
  return basis.surface_points(mesh, {label}, 4);
}

SurfacePoints CubeScene::boundary(const LagrangeBasis& basis) const {
  return basis.surface_points(mesh, {1, 2, 3, 4, kCubeBottom, kCubeTop}, 4);
}

double CubePlacement::length() const {
  return kCubeSize / std::cbrt(num_zones());
}

WallPoints CubePlacement::wall_points(const QuadraturePoints& points) const {
  WallPoints out{points.tet, points.barycentric, points.weights, {0}};
  for (int q = 1; q <= points.size(); ++q)
    if (q == points.size() || zone[points.tet[q]] != zone[points.tet[q - 1]]) out.starts.push_back(q);
  return out;
}

CubePlacement place_cube(const CubeScene& scene, int zones, int points, std::mt19937_64& random) {
  CubePlacement out;
  for (;; ++out.redraws) {
    GeodesicRegions regions = lloyd_regions(scene.solver, random_seeds(scene.mesh, zones, random));
    try {
      out.weights = std::make_shared<RegionWeights>(
          scene.mesh, normalised_border_distances(scene.solver, regions.label, zones));
    } catch (const InputError&) {
      if (out.redraws < 50) continue;
      throw;
    }
    out.zone = std::move(regions.label);
    out.nodes.resize(3, zones);
    for (int i = 0; i < zones; ++i) out.nodes.col(i) = scene.mesh.tet_centroid(regions.seeds[i].tet);
    break;
  }
  out.integration = integration_regions(scene.solver, out.zone, zones, points, random);
  return out;
}

std::shared_ptr<const Basis> blending_basis(const CubeScene& scene, const CubePlacement& placement) {
  std::vector<ControlNode> nodes;
  for (int i = 0; i < placement.num_zones(); ++i) nodes.push_back({placement.nodes.col(i), Mat3::Identity()});
  const auto frames =
      std::make_shared<RegionFrames>(scene.linear, placement.weights, std::move(nodes), placement.length());
  return std::make_shared<FrameBasis>(
      frames, std::vector<FrameFunctions>(placement.num_zones(), {affine_monomials()}));
}

}  // namespace cardiac
