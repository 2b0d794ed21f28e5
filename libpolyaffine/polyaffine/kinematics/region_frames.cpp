#include "polyaffine/kinematics/region_frames.hpp"

#include <Eigen/LU>
#include <string>
#include <utility>

#include <polyaffine/core/error.hpp>

namespace polyaffine {

RegionFrames::RegionFrames(std::shared_ptr<const LagrangeBasis> geometry,
                           std::shared_ptr<const RegionWeights> weights, std::vector<ControlNode> nodes,
                           double length, Vector clamp)
    : geometry_(std::move(geometry)),
      weights_(std::move(weights)),
      nodes_(std::move(nodes)),
      length_(length),
      clamp_(std::move(clamp)) {
  if (num_frames() != weights_->num_regions())
    throw InputError("region frames: found " + std::to_string(num_frames()) + " control nodes, expected " +
                     std::to_string(weights_->num_regions()) + ", one a region");
  if (!(length_ > 0))
    throw InputError("region frames: found length " + std::to_string(length_) + " mm, expected more than 0");
  if (clamp_.size() != 0 && clamp_.size() != geometry_->nodes().cols())
    throw InputError("region frames: found " + std::to_string(clamp_.size()) +
                     " values of the clamp factor, expected " + std::to_string(geometry_->nodes().cols()) +
                     ", one a node of the mesh");
  for (const ControlNode& node : nodes_)
    if (!(node.axes.transpose() * node.axes).isIdentity(1e-9))
      throw InputError("region frames: found axes of a control node that are not orthonormal");
}

FramesAtPoint RegionFrames::sample(int tet, const Vec4& barycentric) const {
  const BasisSample at = geometry_->sample(tet, barycentric);
  const Vec3 X = geometry_->nodes()(Eigen::all, at.functions) * at.N;
  // The weights know flat elements; their gradients are carried over to the curved one through its
  // coordinates.
  const auto corner = geometry_->elements().col(tet);
  Mat3 flat;
  for (int k = 0; k < 3; ++k)
    flat.col(k) = geometry_->nodes().col(corner[k + 1]) - geometry_->nodes().col(corner[0]);
  const Mat3 to_curved = (flat * geometry_->jacobian(tet, barycentric).inverse()).transpose();
  const RegionWeightValues phi = weights_->evaluate(tet, barycentric);

  double d = 1;
  Vec3 d_gradient = Vec3::Zero();
  if (clamp_.size() > 0) {
    const Vector nodal = clamp_(at.functions);
    d = at.N.dot(nodal);
    d_gradient = at.gradient * nodal;
  }
  FramesAtPoint out;
  for (int i = 0; i < num_frames(); ++i) {
    if (phi.values[i] == 0) continue;
    const ControlNode& node = nodes_[i];
    FrameSample f;
    f.frame = i;
    f.weight = d * phi.values[i];
    f.weight_gradient = d * (to_curved * phi.gradients.col(i)) + phi.values[i] * d_gradient;
    f.xi = node.axes.transpose() * (X - node.position) / length_;
    f.xi_gradient = node.axes.transpose() / length_;
    out.frames.push_back(f);
  }
  return out;
}

RegionFrames RegionFrames::without_clamp() const {
  return {geometry_, weights_, nodes_, length_};
}

}  // namespace polyaffine
