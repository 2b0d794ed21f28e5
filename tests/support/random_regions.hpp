#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include <polyaffine/geometry/geodesic_regions.hpp>
#include <polyaffine/kinematics/region_frames.hpp>
#include <polyaffine/quadrature/integration_regions.hpp>

#include "support/labelled_box.hpp"

namespace polyaffine::testing {

/// A unit cube of irregular tets in random control regions, with affine frames and one integration point a
/// region of integration.
struct RandomRegions {
  TetMesh mesh = labelled_cube(7, 0.2);
  std::shared_ptr<const LagrangeBasis> geometry = std::make_shared<LagrangeBasis>(mesh, 1);
  std::vector<int> label;
  std::vector<ControlNode> nodes;
  std::shared_ptr<const RegionWeights> weights;
  IntegrationRegions integration;
  std::shared_ptr<const FrameBasis> basis;

  RandomRegions(int count, int points, unsigned seed) {
    std::mt19937_64 random(seed);
    const EikonalSolver solver(mesh);
    const GeodesicRegions regions = lloyd_regions(solver, random_seeds(mesh, count, random));
    label = regions.label;
    for (const MeshPoint& at : regions.seeds) nodes.push_back({mesh.tet_centroid(at.tet), Mat3::Identity()});
    weights = std::make_shared<RegionWeights>(mesh, normalised_border_distances(solver, label, count));
    integration = integration_regions(solver, label, count, points, random);
    basis = std::make_shared<FrameBasis>(std::make_shared<RegionFrames>(geometry, weights, nodes, 0.5),
                                         std::vector<FrameFunctions>(count, {affine_monomials()}));
  }
  RandomRegions(const RandomRegions&) = delete;

  /// The integration points in one block.
  WallPoints points() const {
    const QuadraturePoints& q = integration.points;
    return {q.tet, q.barycentric, q.weights, {0, q.size()}};
  }
  SurfacePoints boundary() const { return geometry->surface_points(mesh, {1, 2, 3, 4, 5, 6}, 4); }
};

}  // namespace polyaffine::testing
