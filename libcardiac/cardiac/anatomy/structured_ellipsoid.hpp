#pragma once

#include <optional>

#include <cardiac/anatomy/idealised.hpp>
#include <polyaffine/mesh/curved_edges.hpp>

namespace cardiac {

/// A mesh with the midpoints that bend its quadratic edges.
struct CurvedMesh {
  polyaffine::TetMesh mesh;
  polyaffine::EdgeMidpoints midpoints;
};

/// Cells of a structured mesh: from apex to base, around the axis, through the wall.
struct StructuredCells {
  int longitudinal, around, through;
};

/// Tetrahedra along the parameter lines X = (r_s sin θ cos ψ, r_s sin θ sin ψ, −r_l cos θ) of the wall, with
/// r_s, r_l linear in the depth t and θ from 0 at the apex in equal steps to the base plane: triangles of the
/// (θ, ψ) surface, their diagonals alternating, carried through the wall as prisms that are cut in three
/// (Dompierre et al. 1999), all edges bent along the parameter lines. It follows the wall with far fewer
/// elements than an unstructured mesh can, labels as in idealised.hpp. Throws InputError for a wrong shape,
/// fewer than 2 cells from apex to base, an odd number or fewer than 4 around, or none through the wall.
/// With `epi_base_z_mm` the base is no plane: its height goes linearly in t from shape.base_z_mm inside to
/// that outside.
CurvedMesh structured_ellipsoid(const TruncatedEllipsoid& shape, const StructuredCells& cells,
                                std::optional<double> epi_base_z_mm = {});

}  // namespace cardiac
