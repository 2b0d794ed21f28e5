#pragma once

#include <cardiac/reduction/discretisation.hpp>
#include <polyaffine/quadrature/cell_gauss.hpp>

namespace cardiac {

/// How many integration points a cell of a reduced model gets, in the wall and on its surfaces.
struct PointCounts {
  polyaffine::CellCounts wall, wall_at_apex;        ///< Gauss points along, around and through the wall
  polyaffine::CellCounts surface, surface_at_apex;  ///< Gauss points along and around the wall
  /// Degrees of the polynomials kept exact in a cell that is no box; on a surface the first one is the total
  /// degree.
  polyaffine::CellDegree exact;
};

/// The counts for the functions of the frames and the number of rings. `sigmoid`: the weights are no tents.
PointCounts point_counts(const polyaffine::FrameBasis& basis, const FrameLayout& layout, bool sigmoid);

}  // namespace cardiac
