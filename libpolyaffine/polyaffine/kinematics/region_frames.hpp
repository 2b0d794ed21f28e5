#pragma once

#include <memory>
#include <vector>

#include <polyaffine/kinematics/frame_basis.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/kinematics/region_weights.hpp>

namespace polyaffine {

/// Where a frame sits: the position of its control node (mm) and its own axes (orthonormal columns).
struct ControlNode {
  Vec3 position = Vec3::Zero();
  Mat3 axes = Mat3::Identity();
};

/// Control frames of arbitrary regions of a mesh: weights φ_i from the regions' geodesic distances
/// (RegionWeights) and Cartesian coordinates ξ = Rᵢᵀ(X − qᵢ)/length about each control node, in the axes Rᵢ
/// of the node. With the monomials 1, l, c, t they reproduce every affine map of the whole mesh exactly.
///
/// A clamp factor d(X), given at the nodes of the geometry, multiplies all weights: where it is zero on all
/// nodes of a face the displacement vanishes on that face whatever the coefficients, while its slope stays
/// free. The weights then sum to d instead of one.
class RegionFrames : public FrameField {
 public:
  /// `geometry`: the (curved) elements of the mesh of `weights`, whose vertices are its first nodes; `length`
  /// in mm; `clamp` without unit, one value a node of the geometry, or empty. The mesh of the weights must
  /// outlive the frames. Throws InputError when the numbers do not match, axes are not orthonormal, or the
  /// length is not positive.
  RegionFrames(std::shared_ptr<const LagrangeBasis> geometry, std::shared_ptr<const RegionWeights> weights,
               std::vector<ControlNode> nodes, double length, Vector clamp = {});

  int num_frames() const override { return static_cast<int>(nodes_.size()); }
  /// Frames in ascending order; those whose weight is exactly zero (compact support) are left out.
  FramesAtPoint sample(int tet, const Vec4& barycentric) const override;

  const std::vector<ControlNode>& nodes() const { return nodes_; }
  double length() const { return length_; }  ///< mm
  /// The same frames with a partition of unity as weights.
  RegionFrames without_clamp() const;

 private:
  std::shared_ptr<const LagrangeBasis> geometry_;
  std::shared_ptr<const RegionWeights> weights_;
  std::vector<ControlNode> nodes_;
  double length_;
  Vector clamp_;
};

}  // namespace polyaffine
