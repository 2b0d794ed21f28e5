#pragma once

#include <map>
#include <memory>

#include <cardiac/anatomy/right_ventricle.hpp>
#include <cardiac/reduction/segment_frames.hpp>

namespace cardiac {

/// The control frames of two ventricles: those of SegmentFrames in the left wall and the septum and rows of
/// frames in the right free wall, with weights φ_i (1 − σ(w)) and χ_j σ(w), a partition of unity. The switch
/// σ, a cubic step of the transventricular coordinate, passes from one set to the other in the wall at the
/// insertions, never through blood.
///
/// χ_j are piecewise linear in the apicobasal coordinate between the rows and in the rotational coordinate of
/// the right free wall between the nodes of a row, constant beyond its ends; the apex row has one node. Local
/// coordinates ξ = (l, c, t) are lengths from the node along and across the free wall and depth from its
/// middle over the layout's length. The axes of a point, Q, are those of the left ventricle: frames of the
/// right one take Cartesian coefficients. With base frames the right free wall has as many at u = 1 as its
/// last row has nodes, numbered after the left ones.
class BiventricularFrames : public SegmentFrames {
 public:
  /// The coordinates and the layout have a right ventricle.
  BiventricularFrames(std::shared_ptr<const VentricularCoordinates> coordinates, FrameLayout layout,
                      bool base_frames);

  int num_frames() const override { return first_base_ + (base_frames() ? layout().right.back().nodes : 0); }
  polyaffine::FramesAtPoint sample(int tet, const polyaffine::Vec4& barycentric) const override;
  bool at_apex(int cell) const override;
  PointCell point_cell(int tet, const polyaffine::Vec4& barycentric) const override;
  /// Whether a frame belongs to the right free wall.
  bool is_right(int frame) const;

 private:
  struct Interval {
    std::size_t lower = 0;  ///< row below (the base row is the last)
    double share = 0;       ///< of the way to the row above, 0 to 1
    double slope = 0;       ///< of the share by u
  };
  Interval interval(double u) const;
  // A point in or near the right free wall: where it is, in the coordinates of both ventricles.
  struct RightPoint {
    polyaffine::Vec3 X;
    CoordinateSample left;
    RightVentricularCoordinates::Sample right;
    RightVentricularCoordinates::Border border;
  };
  void set_local(const RightRow& row, int node, const RightPoint& at, polyaffine::FrameSample& f) const;
  void add_row(std::size_t k, double share, double slope, const RightPoint& at,
               std::vector<polyaffine::FrameSample>& frames) const;
  // The part of an interval between two breaks of ψ (nodes of its rows, ends of the free wall), numbered over
  // all intervals, and the place of ψ in it, 0 to 1.
  struct Sector {
    int number = 0;
    double place = 0;
  };
  Sector sector(std::size_t lower, double psi) const;

  const RightVentricularCoordinates& right_;
  std::vector<RightRow> rows_;  // with the base row
  int first_base_;
  double length_mm_ = 1;  // along the right free wall for a unit of u
  polyaffine::Vec3 apex_ = polyaffine::Vec3::Zero();
};

/// The frames of one ventricle or of both, as the coordinates are.
std::shared_ptr<const SegmentFrames> tent_frames(std::shared_ptr<const VentricularCoordinates> coordinates,
                                                 const FrameLayout& layout, bool base_frames);

}  // namespace cardiac
