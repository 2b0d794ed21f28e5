#pragma once

#include <array>
#include <vector>

#include <polyaffine/kinematics/basis.hpp>

namespace polyaffine {

/// Highest degrees of the polynomials in three cell coordinates that a compressed rule keeps exactly: all
/// P_a(x)P_b(y)P_c(z) with a/degree[0] + b/degree[1] + c/degree[2] ≤ 1.
using CellDegree = std::array<int, 3>;

/// Legendre polynomials P_0 … P_n of [0, 1], each 1 at x = 1.
Vector legendre(int n, double x);

/// Few points a cell instead of many: candidate points (Gauss points of a mesh) that belong to cell[p], with
/// coordinates (3 × candidates, each 0 to 1 in the cell), are replaced, cell by cell, by at most as many of
/// them as there are polynomials of the degree, with positive weights that integrate these polynomials over
/// the candidates exactly; so the volume and the first moments of every cell are true. Block k of the result
/// is the k-th cell that has points. (Tchakaloff; Sommariva & Vianello 2015.)
WallPoints compress_cells(const WallPoints& candidates, const std::vector<int>& cell,
                          const Points& coordinates, const CellDegree& degree);

/// The same for a surface, with two cell coordinates (2 × points): the areas and the vector areas n dA of
/// every cell are kept exactly against the polynomials P_a(x)P_b(y) of total degree up to `degree` and half
/// of it. So the closed integral of n vanishes as before, and a pressure does no work on a translation.
SurfacePoints compress_surface_cells(const SurfacePoints& candidates, const std::vector<int>& cell,
                                     const Matrix& coordinates, int degree);

/// The points of every cell, from the cell of every point; none for a number that is not used.
std::vector<std::vector<int>> points_of_cells(const std::vector<int>& cell);

/// Puts the blocks of `more` after those of a rule.
void append(const WallPoints& more, WallPoints& rule);
void append(const SurfacePoints& more, SurfacePoints& rule);

/// The candidates themselves, sorted into one block a cell.
WallPoints group_cells(const WallPoints& candidates, const std::vector<int>& cell);

}  // namespace polyaffine
