#pragma once

#include <memory>
#include <vector>

#include <cardiac/reduction/segment_frames.hpp>

namespace cardiac {

/// Frames of a left ventricle with further ones where AHA segments differ: strain jumps there, and tents
/// between the nodes in the middle of the segments have no kink at their borders. One more frame sits on
/// every border between two segments that differ, and one in every corner of a group of alike segments. Its
/// weight is a hat, 1 there and 0 at the nodes around it: along the wall the tent of the ring, or over a
/// border between two rings a/(a + b), with the distances a to the ring and b to the border, both in u;
/// around the wall the tent of the nodes, or a hat over a border. The weights of the frames themselves stay
/// as they are, so those of all do not sum to one; further frames are meant for functions of the depth alone,
/// ξ = (0, 0, t − ½) times the thickness of the apical ring over the layout's length.
/// With a right ventricle the hats fade like the left frames' weights.
class BorderFrames : public polyaffine::FrameField {
 public:
  /// Segments of the same number kind[s − 1] are alike. The layout has AHA's rings.
  BorderFrames(std::shared_ptr<const SegmentFrames> frames, const std::vector<int>& kind);

  int num_frames() const override { return frames_->num_frames() + static_cast<int>(hats_.size()); }
  polyaffine::FramesAtPoint sample(int tet, const polyaffine::Vec4& barycentric) const override;

 private:
  struct Hat {
    int low = 0, high = 0;  // rings (aha_ring) that it lies between; equal: in the middle of one
    double angle = 0;       // of its top, rad
    double half_width = 0;  // rad
  };
  struct Value {
    double value = 0;
    polyaffine::Vec3 gradient = polyaffine::Vec3::Zero();
  };
  void add_in_rings(const std::vector<int>& kind);
  void add_between_rings(const std::vector<int>& kind);
  Value along(const Hat& hat, const CoordinateSample& at, const polyaffine::Vec3& X) const;

  std::shared_ptr<const SegmentFrames> frames_;
  std::vector<double> positions_;  // u of the cap, the rings and the base
  std::vector<Hat> hats_;
};

}  // namespace cardiac
