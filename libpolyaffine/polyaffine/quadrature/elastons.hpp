#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/quadrature/integration_regions.hpp>

namespace polyaffine {

/// Moments of the monomials {1, x, y, z} about a centre, m_ab = ∫ p_a p_b dV with p = [1; X − centre]:
/// volume (mm³), first (mm⁴) and second moments (mm⁵).
using Moments = Eigen::Matrix4d;

/// Moments of tet t, exact: its second moments about its centroid c are V/20 Σ_a (x_a − c)(x_a − c)ᵀ.
Moments tet_moments(const TetMesh& mesh, int t, const Vec3& centre);

/// An integration point that knows the shape of its region (Martin et al. 2010). Order 0 keeps the volume
/// only (the other moments are zero), order 1 the moments to degree two. With a strain E_0 + Σ_k E_k (X −
/// centre)_k that is linear in its region the energy of an isotropic linear law H is W = ½ Σ_ab m_ab E_a : H
/// : E_b.
struct Elaston {
  Vec3 centre;  ///< the integration point, mm
  Moments moments;
};

/// One elaston for each integration region, about its point; the moments are sums over its tets.
/// Throws std::invalid_argument when order is neither 0 nor 1.
std::vector<Elaston> elastons(const TetMesh& mesh, const IntegrationRegions& regions, int order);

/// The elastons of integration regions as integration points. Order 0: the region's point with its volume.
/// Order 1: four points of a quarter of the volume each at the vertices of the tetrahedron that has the
/// moments of the region to degree two; so a strain that is linear in X has exactly the energy of the
/// elastons, for any law, and the derivatives are those of FieldEnergy. The points are given in the tet of
/// the region's point, from which the functions are continued (barycentric coordinates may be negative): as
/// in an elaston, all that is known comes from one place. Four (one) consecutive points a region.
/// Throws std::invalid_argument when order is neither 0 nor 1.
QuadraturePoints elaston_points(const TetMesh& mesh, const IntegrationRegions& regions, int order);

}  // namespace polyaffine
