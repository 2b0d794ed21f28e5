#pragma once

#include <array>

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/quadrature/cell_place.hpp>
#include <polyaffine/quadrature/cell_rule.hpp>

namespace polyaffine {

/// Gauss–Legendre points along the three coordinates of a cell.
using CellCounts = std::array<int, 3>;

/// A product Gauss rule in every cell. The candidates (as for compress_cells; the rule of a mesh) tell how
/// much volume there is: with the orthonormal Legendre polynomials P_k of degrees below the counts, its
/// density in the coordinates x of the cell is ρ(x) = Σ_k P_k(x) Σ_p w_p P_k(x_p). The points themselves lie
/// at the Gauss points x_q of the cell, with the weights of the line rules times ρ(x_q). Sums over them of
/// all P_k are those over the candidates, the volume among them, and nothing depends on the elements that
/// happen to fill the cell. A cell that is no box (a weight that is not positive, a place that no element
/// holds) is left to compress_cells with the degree `otherwise`. Blocks as for compress_cells.
WallPoints gauss_cells(const WallPoints& candidates, const std::vector<int>& cell, const Points& coordinates,
                       const PlaceOf& place_of, const std::function<CellCounts(int cell)>& counts,
                       const CellDegree& otherwise);

/// The same for a surface in the first two coordinates: the sums of P_k n dA are kept exactly, and so the
/// closed integral of n vanishes as before. `geometry` tells positions. The third count is not used.
SurfacePoints gauss_surface_cells(const SurfacePoints& candidates, const std::vector<int>& cell,
                                  const Matrix& coordinates, const PlaceOf& place_of,
                                  const std::function<CellCounts(int cell)>& counts, int otherwise,
                                  const LagrangeBasis& geometry);

}  // namespace polyaffine
