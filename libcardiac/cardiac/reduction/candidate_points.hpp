#pragma once

#include <cardiac/reduction/discretisation.hpp>
#include <cardiac/reduction/segment_cells.hpp>

namespace cardiac {

/// The points of the mesh from which the integration points of a reduced model are chosen.
struct CandidatePoints {
  polyaffine::WallPoints wall;
  FaceRule face;  ///< rule of the faces of its surfaces
};

/// Gauss points of every element.
CandidatePoints plain_candidates(const polyaffine::LagrangeBasis& geometry);

/// Gauss points of every element, and of the parts of those that the border of a cell crosses: they see each
/// cell as it is, not to the nearest element. The heart must outlive the rule of the faces; the points do not
/// depend on the order of the nodes in the file.
CandidatePoints split_candidates(const VentricularCoordinates& heart, const SegmentCells& cells);

}  // namespace cardiac
