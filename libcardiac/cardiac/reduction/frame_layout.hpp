#pragma once

#include <vector>

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/anatomy/segments.hpp>

namespace cardiac {

/// One ring of control nodes around the wall and of the regions they own.
struct FrameRing {
  double u = 0;          ///< apicobasal coordinate of the nodes
  int nodes = 0;         ///< evenly spaced
  double angle = 0;      ///< rotational coordinate of the first node, rad
  int first_frame = 0;   ///< frame of the first node
  double radius = 0;     ///< mean distance to the axis in the regions, mm
  double thickness = 0;  ///< mean of the wall in the regions, mm

  double step() const { return 2 * polyaffine::kPi / nodes; }  ///< angle between two nodes, rad
  /// Rotational coordinate of node j = 0 … nodes − 1, up to π (rad).
  double node_angle(int j) const;
};

/// A row of control nodes across the right free wall, from the anterior to the inferior insertion.
struct RightRow {
  double u = 0;  ///< apicobasal coordinate of the nodes
  int nodes = 0;
  int first_frame = 0;

  double step() const { return 2.0 / nodes; }                          ///< of ψ between two nodes
  double node_psi(int j) const { return -1 + (2 * j + 1.0) / nodes; }  ///< rotational coordinate of node j
};

/// How many control nodes there are and where; AHA's 17 segments unless something else is asked for.
struct RingOptions {
  std::vector<int> nodes{4, 6, 6};  ///< of each ring, apex to base
  std::vector<double> positions{};  ///< apicobasal coordinate of each ring; empty: see frame_layout
  std::vector<double> angles{};     ///< rotational coordinate of each ring's first node, rad; empty: 0
};

/// Control nodes of a left ventricle: one in the cap and rings of them above it, each with the region it
/// owns. Frames are numbered ring by ring from the base to the apex, the cap last: in AHA's layout frame s −
/// 1 belongs to segment s. A right free wall adds twelve, one for each of the segments 18–29 in their order.
struct FrameLayout {
  std::vector<FrameRing> rings;  ///< apex to base
  double cap_thickness = 0;      ///< mean of the wall in the cap, mm
  double length = 1;             ///< mm by which local coordinates are divided
  bool follows_segments = true;  ///< the regions are the AHA segments
  std::vector<RightRow> right;   ///< apex (one node) to base; empty without a right ventricle
  double right_radius = 0;       ///< mean distance of the right free wall to its axis, mm
  double right_thickness = 0;    ///< mean of the right free wall, mm

  int num_nodes() const { return cap() + 1 + num_right(); }
  int num_right() const {
    return right.empty() ? 0 : right.front().first_frame + 1 - right.back().first_frame;
  }
  int cap() const { return rings.front().first_frame + rings.front().nodes; }
  /// Frame that owns a place where the regions do not follow the segments: its border to the next ring (or
  /// the cap, u = 0) is half way between their positions, that within a ring half way between the angles.
  int region(double u, double psi) const;
};

/// Rows of the right free wall lie at shares 0, .3, .55 and .85 of the way from its apex to the base.
///
/// Layout on a mesh. Without positions, rings of AHA's layout (4, 6, 6 nodes from angle 0) lie at
/// u = 0.2, 0.5, 0.85; n rings of another layout at u_k = k/(n + ½), k = 1 … n: evenly
/// spaced, the cap and the last ring's upper half owning half a space each. The unit of length is the cube
/// root of the mean volume of a region. Throws InputError when a ring has fewer than three nodes, the numbers
/// of rings differ, positions do not rise between 0 and 1, or a region has no tet.
FrameLayout frame_layout(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                         const RingOptions& options = {});

/// Frame whose region each tet belongs to, by its centroid; AHA segment − 1 where the regions follow the
/// segments.
std::vector<int> region_tets(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                             const FrameLayout& layout);

}  // namespace cardiac
