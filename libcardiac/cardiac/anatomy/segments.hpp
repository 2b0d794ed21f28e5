#pragma once

#include <array>
#include <string>
#include <vector>

#include <cardiac/anatomy/coordinates.hpp>

namespace cardiac {

inline constexpr int kAhaSegments = 17;

/// Name of AHA segment 1–17 (Cerqueira et al. 2002).
const std::string& aha_name(int segment);

/// AHA segment (1–17) of a position from its height along the long axis (0 apex of the cavity, 1 base) and
/// its rotational coordinate ψ (0 anterior, growing towards the septum): thirds of the axis, the cap below
/// the cavity, six sectors of 60° (basal, mid) or four of 90° (apical) centred on the anterior wall
/// (Cerqueira et al. 2002).
int aha_segment(double long_axis_height, double psi);

/// Share of each segment (index 0 for segment 1) in a position: 1 inside, with a smooth border (S-shaped
/// cubic) whose full width is the fraction `border` of a segment's height and angle, centred on the segment's
/// edge. Sums to one.
std::array<double, kAhaSegments> segment_shares(double long_axis_height, double psi, double border);

/// Rotational coordinate of the middle of a segment, rad; 0 for segment 17.
double aha_centre_angle(int segment);
/// Ring of a segment: 0 the cap, 1 apical, 2 mid, 3 basal.
int aha_ring(int segment);
/// First segment and number of segments of a ring.
int aha_ring_first(int ring);
int aha_ring_size(int ring);

/// Segment of each tet, by its centroid. Throws InputError naming a segment that has no tet.
std::vector<int> segment_tets(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates);

/// Volume of each segment, mm³, index 0 for segment 1.
std::vector<double> segment_volumes(const polyaffine::TetMesh& mesh, const std::vector<int>& segment);

}  // namespace cardiac
