#pragma once

#include <memory>

#include <cardiac/reduction/frame_layout.hpp>
#include <polyaffine/kinematics/frame_basis.hpp>

namespace cardiac {

/// The frames of another field and, numbered after them, one more over the whole heart: its weight is 1
/// everywhere, its local coordinates are Cartesian about the centre of the base in units of the layout's
/// length. With the functions x, y, z of this frame (and 1 where the others' coefficients turn with the wall)
/// a reduced space holds every affine map of the heart, and with it every rigid motion, to rounding: blends
/// of frames in curved coordinates alone do not.
class GlobalFrame : public polyaffine::FrameField {
 public:
  GlobalFrame(std::shared_ptr<const polyaffine::FrameField> frames,
              std::shared_ptr<const VentricularCoordinates> coordinates, double length_mm);

  int num_frames() const override { return frames_->num_frames() + 1; }
  polyaffine::FramesAtPoint sample(int tet, const polyaffine::Vec4& barycentric) const override;

 private:
  std::shared_ptr<const polyaffine::FrameField> frames_;
  std::shared_ptr<const VentricularCoordinates> coordinates_;
  double length_mm_;
};

}  // namespace cardiac
