#pragma once

#include <array>
#include <string>
#include <vector>

#include <cardiac/anatomy/coordinates.hpp>

namespace cardiac {

inline constexpr int kAhaSegments = 17;        ///< of the left ventricle
inline constexpr int kBothSegments = 17 + 12;  ///< with the right free wall
inline constexpr int kAhaRings = 3;            ///< of segments, beside the cap

/// Name of AHA segment 1–17 (Cerqueira et al. 2002), or of segment 18–29 of the right free wall: 18–21 basal,
/// 22–25 mid, 26–28 apical, each from the anterior to the inferior insertion, 29 the apex. They mirror the
/// left ventricle's without its septal ones; the standard has no segments of the right ventricle.
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

/// Segment 18–29 of a place in the right free wall from its height (0 bottom of the cavity, 1 rim) and its
/// rotational coordinate (−1 anterior to 1 inferior border): the apex is the lowest eighth, above it the
/// borders are those of thirds.
int right_segment(double height, double psi);

/// Segments that the coordinates divide a wall into: 17, or 29 with a right ventricle.
int num_segments(const VentricularCoordinates& coordinates);

/// Segment of the point X of the mesh, in a tet at barycentric coordinates.
int segment_at(const VentricularCoordinates& coordinates, int tet, const polyaffine::Vec4& barycentric,
               const polyaffine::Vec3& X);

/// Share of each segment (num_segments) in a point of the mesh: segment_shares in the left wall and the
/// septum, the segment itself in the right free wall.
std::vector<double> shares_at(const VentricularCoordinates& coordinates, int tet,
                              const polyaffine::Vec4& barycentric, double border);

/// Segment of each tet, by its centroid; each segment connected (polyaffine::connect_regions). Throws
/// InputError naming a segment that has no tet.
std::vector<int> segment_tets(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates);

/// Volume of each of `count` segments, mm³, index 0 for segment 1.
std::vector<double> segment_volumes(const polyaffine::TetMesh& mesh, const std::vector<int>& segment,
                                    int count = kAhaSegments);

}  // namespace cardiac
