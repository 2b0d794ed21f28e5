#pragma once

#include <vector>

#include <cardiac/reduction/discretisation.hpp>
#include <cardiac/reduction/segment_cells.hpp>

namespace cardiac {

/// The cell in which each candidate point lies and its place there, each coordinate from 0 to 1.
struct CandidateCells {
  std::vector<int> cell;
  polyaffine::Points place;
};

/// The cells between the kinks of tent weights and the borders of segments that differ.
CandidateCells cells_of_tents(const SegmentCells& cells, const std::vector<int>& tet,
                              const Eigen::Matrix4Xd& barycentric);

/// The regions of the frames themselves, each scaled to the range of its own points.
CandidateCells cells_of_regions(const VentricularCoordinates& heart, const Discretisation& discretisation,
                                const std::vector<int>& tet, const Eigen::Matrix4Xd& barycentric);

}  // namespace cardiac
