#pragma once

#include <memory>

#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/kinematics/gmls.hpp>
#include <polyaffine/kinematics/region_weights.hpp>

namespace polyaffine {

/// GMLS frames of regions of a mesh: functions 4i + m of node i, m = 0 its value function N_i, m = 1…3 its
/// derivative functions N_i^k (see gmls_functions), with the region weights φ_i as kernel. The coefficients
/// of an affine map u are u(q_i) and length·∂_k u, and every such map is reproduced exactly. Unlike direct
/// blending of affine frames, which weights each map at the point, the map is fitted anew at every point.
class GmlsBasis : public Basis {
 public:
  /// nodes: 3 × regions, mm; `length` (mm): the size of a region. Keeps a reference to the mesh. Throws
  /// InputError when the numbers differ or the length is not positive.
  GmlsBasis(const TetMesh& mesh, std::shared_ptr<const RegionWeights> weights, Points nodes, double length);
  GmlsBasis(TetMesh&&, std::shared_ptr<const RegionWeights>, Points, double) = delete;

  int num_functions() const override { return static_cast<int>(4 * nodes_.cols()); }
  /// Functions of nodes whose weight is exactly zero (compact support) are left out.
  BasisSample sample(int tet, const Vec4& barycentric) const override;

 private:
  const TetMesh& mesh_;
  std::shared_ptr<const RegionWeights> weights_;
  Points nodes_;
  double length_;
};

}  // namespace polyaffine
