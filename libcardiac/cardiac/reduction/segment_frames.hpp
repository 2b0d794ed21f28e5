#pragma once

#include <memory>
#include <vector>

#include <cardiac/reduction/frame_layout.hpp>
#include <polyaffine/kinematics/frame_basis.hpp>

namespace cardiac {

/// Axes of the frame of the cap, columns longitudinal (there: anterior), circumferential, radial (out of the
/// apex), and its node, half the thickness below the apex of the cavity (mm).
polyaffine::Mat3 cap_axes(const VentricularCoordinates& coordinates);
polyaffine::Vec3 cap_node_position(const VentricularCoordinates& coordinates, const FrameLayout& layout);

/// The control frames of a layout with piecewise linear weights in the apicobasal and rotational coordinates,
/// φ_i = R_k(u) C_j(ψ), a partition of unity; with base frames as many more at u = 1 as the last ring has
/// nodes, above them and numbered after the cap. Local coordinates ξ = (l, c, t): arc length from the node
/// along and around the wall and depth from mid-wall, divided by the layout's length. The frame of the cap
/// has Cartesian coordinates in its own fixed axes about a point on the long axis.
///
/// Base frames that carry only functions with a factor l vanish on the base, which clamps it exactly while
/// its slope stays free.
class SegmentFrames : public polyaffine::FrameField {
 public:
  SegmentFrames(std::shared_ptr<const VentricularCoordinates> coordinates, FrameLayout layout,
                bool base_frames);

  int num_frames() const override {
    return layout_.num_nodes() + (base_frames_ ? layout_.rings.back().nodes : 0);
  }
  bool base_frames() const { return base_frames_; }
  polyaffine::FramesAtPoint sample(int tet, const polyaffine::Vec4& barycentric) const override;

  const FrameLayout& layout() const { return layout_; }
  const VentricularCoordinates& coordinates() const { return *coordinates_; }

  /// Cell of the wall in which all weights are smooth (they have kinks at the rings and at the nodes'
  /// angles).
  struct Cell {
    int index = 0;
    double u = 0, psi = 0;  ///< position within the cell, each 0 to 1
    double length = 0;      ///< of the cell in the apicobasal coordinate
    double angle = 0;       ///< rotational coordinate at which it begins, rad
    double width = 0;       ///< rad
  };
  Cell cell(double u, double psi) const;
  /// The cell of a point of the mesh and its place in it, three coordinates from 0 to 1.
  struct PointCell {
    int index = 0;
    polyaffine::Vec3 place;
  };
  virtual PointCell point_cell(int tet, const polyaffine::Vec4& barycentric) const;
  int num_cells() const { return cell_start_.back(); }
  /// Whether a cell reaches the axis of its ventricle, where the wall bends most; those of the left one are
  /// numbered first.
  virtual bool at_apex(int cell) const { return cell < cell_start_[1]; }

 private:
  // A tent at a point, and its slope in its coordinate.
  struct Hat {
    double value = 0, slope = 0;
  };
  polyaffine::FrameSample cap_sample(const Hat& along, const CoordinateSample& at,
                                     const polyaffine::Vec3& X) const;
  void add_ring(std::size_t k, const Hat& along, const CoordinateSample& at,
                std::vector<polyaffine::FrameSample>& frames) const;

  std::shared_ptr<const VentricularCoordinates> coordinates_;
  FrameLayout layout_;
  bool base_frames_;
  polyaffine::Mat3 cap_axes_;
  polyaffine::Vec3 cap_node_;
  std::vector<double> positions_;            // of the cap, the rings and the base
  std::vector<std::vector<double>> breaks_;  // rotational breaks of each apicobasal interval, in [0, 2π)
  std::vector<int> cell_start_;
};

}  // namespace cardiac
