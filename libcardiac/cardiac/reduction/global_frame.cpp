#include "cardiac/reduction/global_frame.hpp"

#include <utility>

namespace cardiac {

GlobalFrame::GlobalFrame(std::shared_ptr<const polyaffine::FrameField> frames,
                         std::shared_ptr<const VentricularCoordinates> coordinates, double length_mm)
    : frames_(std::move(frames)), coordinates_(std::move(coordinates)), length_mm_(length_mm) {}

polyaffine::FramesAtPoint GlobalFrame::sample(int tet, const polyaffine::Vec4& barycentric) const {
  polyaffine::FramesAtPoint out = frames_->sample(tet, barycentric);
  polyaffine::FrameSample frame;
  frame.frame = frames_->num_frames();
  frame.weight = 1;
  frame.xi = (coordinates_->position(tet, barycentric) - coordinates_->base_centre()) / length_mm_;
  frame.xi_gradient = polyaffine::Mat3::Identity() / length_mm_;
  out.frames.push_back(frame);
  return out;
}

}  // namespace cardiac
