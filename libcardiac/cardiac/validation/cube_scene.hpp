#pragma once

#include <memory>
#include <random>
#include <vector>

#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/kinematics/region_weights.hpp>
#include <polyaffine/material/parameters.hpp>
#include <polyaffine/quadrature/integration_regions.hpp>

namespace cardiac {

/// The cube of the poly-affine paper: [0, 1]³ m (here in mm), compressed along z by 2000 N on bottom and top,
/// E = 15 MPa, ν = 0.49, small strain.
inline constexpr double kCubeSize = 1000;                             // mm
inline constexpr polyaffine::Elasticity kCubeElasticity{15000, .49};  // kPa
inline constexpr double kCubePressure = 2;                            // kPa: 2000 N on 1 m²

/// Boundary labels of ValidationContext::mesh_box.
inline constexpr int kCubeBottom = 5, kCubeTop = 6;

/// Meshed cube with what all placements share.
struct CubeScene {
  polyaffine::TetMesh mesh;
  std::shared_ptr<const polyaffine::LagrangeBasis> linear, quadratic;  ///< over the mesh
  polyaffine::EikonalSolver solver;

  explicit CubeScene(polyaffine::TetMesh of);
  CubeScene(const CubeScene&) = delete;
  CubeScene& operator=(const CubeScene&) = delete;

  polyaffine::SurfacePoints face(const polyaffine::LagrangeBasis& basis, int label) const;
  polyaffine::SurfacePoints boundary(const polyaffine::LagrangeBasis& basis) const;
};

/// Zones and integration points placed at random, as the paper does: Voronoi seeds among the tets, relaxed by
/// Lloyd's algorithm; the points by the same process inside the zones.
struct CubePlacement {
  std::vector<int> zone;     ///< of each tet
  polyaffine::Points nodes;  ///< control nodes, mm
  std::shared_ptr<const polyaffine::RegionWeights> weights;
  polyaffine::IntegrationRegions integration;
  int redraws = 0;  ///< draws thrown away because a zone was less than two tets wide

  int num_zones() const { return static_cast<int>(nodes.cols()); }
  /// The control frames' reference length: the edge of a cube of a zone's mean volume, mm.
  double length() const;
  /// Integration points in one block a zone.
  polyaffine::WallPoints wall_points(const polyaffine::QuadraturePoints& points) const;
};

/// Draws again, at most 50 times, when a zone has no vertex inside; then throws as
/// normalised_border_distances.
CubePlacement place_cube(const CubeScene& scene, int zones, int points, std::mt19937_64& random);

/// Affine frames of the placement by direct blending with region weights.
std::shared_ptr<const polyaffine::Basis> blending_basis(const CubeScene& scene,
                                                        const CubePlacement& placement);

}  // namespace cardiac
