#pragma once

#include <cardiac/core/beat_result.hpp>
#include <cardiac/reduction/control_nodes.hpp>
#include <cardiac/run/beat.hpp>
#include <cardiac/run/key_states.hpp>

namespace cardiac {

/// A node for the affine map of every AHA segment: its control node where the scene's frames belong to the
/// segments, otherwise the one it would have then.
std::vector<ControlNode> segment_nodes(const Anatomy& anatomy, const Scene& scene);

/// What a path means in segments, volumes and pressures, with nodes from segment_nodes. Strains, affine maps
/// and contours are against end diastole (without a beat: the first state). Wall times, plan and scene
/// warnings are the caller's.
BeatResult describe_path(const Ventricle& ventricle, const std::vector<ControlNode>& nodes,
                         const Scene& scene, const HeartPath& path);

}  // namespace cardiac
