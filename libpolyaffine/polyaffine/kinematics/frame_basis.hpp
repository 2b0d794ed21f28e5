#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <polyaffine/kinematics/basis.hpp>

namespace polyaffine {

/// ξ₁^a ξ₂^b ξ₃^c in the local coordinates of a frame.
using Monomial = std::array<int, 3>;

/// "1", or a product of the letters l, c, t for ξ₁, ξ₂, ξ₃ ("l", "tt", "ltt"). Throws InputError.
Monomial parse_monomial(const std::string& text);
/// The affine functions 1, l, c, t.
std::vector<Monomial> affine_monomials();

/// Weight φ of one frame at a point and its local coordinates ξ, with gradients (∇φ 1/mm; row k of
/// `xi_gradient` is ∇ξ_k).
struct FrameSample {
  int frame = 0;
  double weight = 0;
  Vec3 weight_gradient = Vec3::Zero();
  Vec3 xi = Vec3::Zero();
  Mat3 xi_gradient = Mat3::Zero();
};

/// The frames whose weight does not vanish at a point, and the local axes there.
struct FramesAtPoint {
  std::vector<FrameSample> frames;
  Mat3 Q = Mat3::Identity();
  std::array<Mat3, 3> dQ{Mat3::Zero(), Mat3::Zero(), Mat3::Zero()};  ///< ∂Q/∂X_J
};

/// Weights (a partition of unity) and local coordinates of control frames over a mesh.
class FrameField {
 public:
  virtual ~FrameField() = default;
  virtual int num_frames() const = 0;
  virtual FramesAtPoint sample(int tet, const Vec4& barycentric) const = 0;
};

/// What one frame contributes.
struct FrameFunctions {
  std::vector<Monomial> monomials;
  bool local_axes = false;  ///< coefficients in the axes Q(X) of the point instead of Cartesian ones
};

/// Functions φ_i(X) m(ξ_i(X)) of control frames. With the monomials 1, l, c, t a frame has 12 unknowns: its
/// displacement at the node and, divided by the lengths of ξ, the columns of its affine map.
class FrameBasis : public Basis {
 public:
  FrameBasis(std::shared_ptr<const FrameField> field, std::vector<FrameFunctions> frames);

  int num_functions() const override { return static_cast<int>(function_frame_.size()); }
  BasisSample sample(int tet, const Vec4& barycentric) const override;
  bool in_local_axes(int function) const override { return frames_[function_frame_[function]].local_axes; }

  /// Index of the function of a frame with a monomial, −1 when it has none.
  int function(int frame, const Monomial& monomial) const;
  const FrameField& field() const { return *field_; }
  /// The functions of each frame, without repetitions.
  const std::vector<FrameFunctions>& frames() const { return frames_; }

 private:
  std::shared_ptr<const FrameField> field_;
  std::vector<FrameFunctions> frames_;
  std::vector<int> first_function_, function_frame_;
};

/// Values φ_i m(ξ_i) of the same kind of functions at points, for pressure spaces: functions × points, and
/// their number; frames without monomials have no function.
Matrix frame_values(const FrameField& field, const std::vector<std::vector<Monomial>>& monomials,
                    const std::vector<int>& tet, const Eigen::Matrix4Xd& barycentric);

}  // namespace polyaffine
