#pragma once

#include <vector>

#include <cardiac/reduction/discretisation.hpp>

namespace cardiac {

/// A number for each segment (index 0 for segment 1; 29 of them), the same where the scene's [[region]]s
/// ask for the same stiffness and, where the wall contracts, tension and delay.
std::vector<int> segment_kinds(const Scene& scene);

/// Sets the integration points of a reduced model, whose frames, functions and regions are there, in the wall
/// and on its surfaces. With tents: Gauss points of the cells between the kinks of the weights and the
/// borders of segments that differ (SegmentCells, polyaffine::gauss_cells). With sigmoid weights: few points
/// of the elements in every region (polyaffine::compress_cells). With reduction.integration = gauss the wall
/// has those of all elements.
void add_reduced_points(const Anatomy& anatomy, const Scene& scene, Discretisation& discretisation);

/// Points over which the strain of segments is averaged: of a reduced model with tents those of cells that
/// end at every segment's border (in the right free wall, few points of the elements in every segment), since
/// the integration points of a cell that lies in two segments share it out unevenly; else the integration
/// points.
polyaffine::WallPoints strain_points(const Anatomy& anatomy, const Discretisation& discretisation);

}  // namespace cardiac
