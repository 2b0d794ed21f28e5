#pragma once

#include <vector>

#include <cardiac/reduction/segment_frames.hpp>

namespace cardiac {

/// The node of a control frame: where it lies in the mesh and its axes (columns longitudinal,
/// circumferential, radial; orthonormal).
struct ControlNode {
  int tet = 0;
  polyaffine::Vec4 barycentric = polyaffine::Vec4::Zero();
  polyaffine::Vec3 position = polyaffine::Vec3::Zero();
  polyaffine::Mat3 axes = polyaffine::Mat3::Identity();
};

/// One node a frame, in the layout's order: in the middle of the wall at its ring and angle (the point of the
/// mesh that comes closest, in the right free wall the centre of the closest tet); that of the cap on the
/// long axis, with the axes of the cap's frame. In AHA's layout index 0 is segment 1.
std::vector<ControlNode> control_nodes(const polyaffine::TetMesh& mesh,
                                       const VentricularCoordinates& coordinates, const FrameLayout& layout);

}  // namespace cardiac
