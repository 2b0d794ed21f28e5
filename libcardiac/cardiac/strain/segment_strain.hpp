#pragma once

#include <vector>

#include <cardiac/anatomy/coordinates.hpp>
#include <cardiac/core/beat_result.hpp>
#include <polyaffine/kinematics/basis.hpp>

namespace cardiac {

/// Averages over AHA segments of strains at the integration points of a wall.
class SegmentGauge {
 public:
  SegmentGauge(const VentricularCoordinates& coordinates, const polyaffine::WallPoints& points);

  /// Strain of the deformation gradients F against F_ed (both 9 × points): with F_rel = F F_ed⁻¹ and C =
  /// F_relᵀF_rel in the local axes turned with the end-diastolic rotation of the point, √C_aa − 1 along each
  /// axis, the shears ½ C_ab, and det F_rel; means weighted by volume. One a segment, index 0 for segment 1.
  std::vector<SegmentStrain> strain(const polyaffine::Matrix& F, const polyaffine::Matrix& F_ed) const;

  /// The same for many F against one end diastole: with the axes of reference_axes(F_ed).
  std::vector<SegmentStrain> strain(const polyaffine::Matrix& F,
                                    const std::vector<polyaffine::Mat3>& reference_axes) const;
  /// F_ed⁻¹ times the turned local axes, at each point.
  std::vector<polyaffine::Mat3> reference_axes(const polyaffine::Matrix& F_ed) const;

  /// Mean over each segment of the Green–Lagrange strain ½(FᵀF − I) against the reference configuration, in
  /// the local axes (longitudinal, circumferential, radial), weighted by volume.
  std::vector<polyaffine::Mat3> green_lagrange(const polyaffine::Matrix& F) const;

  /// Mean rotation about the long axis of each segment's points, from positions x_ed to x (3 × points),
  /// degrees, counter-clockwise seen from the apex.
  std::vector<double> rotation_deg(const polyaffine::Points& x, const polyaffine::Points& x_ed) const;

  const polyaffine::Points& positions() const { return X_; }    ///< of the points, reference, mm
  const std::vector<int>& segment() const { return segment_; }  ///< from 1, a number a point
  const polyaffine::Vector& weights() const { return weights_; }

 private:
  const VentricularCoordinates& coordinates_;
  polyaffine::Points X_;
  std::vector<int> segment_;
  polyaffine::Vector weights_;
  std::vector<polyaffine::Mat3> axes_;
};

/// Means over the wall of the left ventricle (segments 1–17): GLS, GCS, GRS are the means of the
/// segments' strains weighted by volume, in percent; twist is the rotation of the apical segments (13–16)
/// minus that of the basal ones (1–6), degrees, positive when the apex turns counter-clockwise seen from the
/// apex against the base, as it does in a healthy heart.
GlobalStrain global_strain(const std::vector<SegmentStrain>& strain, const std::vector<double>& rotation_deg,
                           const std::vector<double>& segment_volumes);

/// The same means over the right free wall (segments 18–29), without twist (NaN).
GlobalStrain right_global_strain(const std::vector<SegmentStrain>& strain,
                                 const std::vector<double>& segment_volumes);

}  // namespace cardiac
