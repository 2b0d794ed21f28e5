#pragma once

#include <array>
#include <memory>
#include <vector>

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/anatomy/segments.hpp>
#include <polyaffine/kinematics/frame_basis.hpp>

namespace cardiac {

/// Where the control frames of the segments sit.
struct FrameLayout {
  std::array<double, 3> rings{};      ///< apicobasal coordinate of the apical, mid and basal ring
  std::array<double, 4> radius{};     ///< distance to the axis about the nodes of each ring (0: the cap), mm
  std::array<double, 4> thickness{};  ///< of the wall about the nodes of each ring, mm
  double length = 1;                  ///< mm by which local coordinates are divided
};

/// Layout from the mesh: each ring at the mean apicobasal coordinate of its segments (or at `rings` when
/// given), the unit of length the cube root of the mean segment volume.
FrameLayout frame_layout(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                         const std::vector<double>& rings = {});

/// Axes of the frame of the cap, columns longitudinal (there: anterior), circumferential, radial (out of the
/// apex), and its node, half the thickness below the apex of the cavity (mm).
polyaffine::Mat3 cap_axes(const VentricularCoordinates& coordinates);
polyaffine::Vec3 cap_node_position(const VentricularCoordinates& coordinates, const FrameLayout& layout);

/// One control frame for each AHA segment with piecewise linear weights in the apicobasal and rotational
/// coordinates, φ_i = R_k(u) C_j(ψ), a partition of unity: frame s − 1 for segment s; with base frames six
/// more at u = 1 above the basal ring. Local coordinates ξ = (l, c, t): arc length from the node along and
/// around the wall and depth from mid-wall, divided by the layout's length. The frame of the cap (17) has
/// Cartesian coordinates in its own fixed axes about a point on the long axis.
///
/// Base frames that carry only functions with a factor l vanish on the base, which clamps it exactly while
/// its slope stays free.
class SegmentFrames : public polyaffine::FrameField {
 public:
  SegmentFrames(std::shared_ptr<const VentricularCoordinates> coordinates, FrameLayout layout,
                bool base_frames);

  int num_frames() const override { return base_frames_ ? kAhaSegments + 6 : kAhaSegments; }
  polyaffine::FramesAtPoint sample(int tet, const polyaffine::Vec4& barycentric) const override;

  const FrameLayout& layout() const { return layout_; }
  const VentricularCoordinates& coordinates() const { return *coordinates_; }

  /// Cell of the wall in which all weights are smooth (they have kinks at the rings and at the nodes'
  /// angles).
  struct Cell {
    int index = 0;
    double u = 0, psi = 0;  ///< position within the cell, each 0 to 1
  };
  Cell cell(double u, double psi) const;
  int num_cells() const { return static_cast<int>(cell_start_.back()); }

 private:
  std::shared_ptr<const VentricularCoordinates> coordinates_;
  FrameLayout layout_;
  bool base_frames_;
  polyaffine::Mat3 cap_axes_;
  polyaffine::Vec3 cap_node_;
  std::array<std::vector<double>, 4> breaks_;  // rotational breaks of each apicobasal interval, in [0, 2π)
  std::array<int, 5> cell_start_{};
};

}  // namespace cardiac
