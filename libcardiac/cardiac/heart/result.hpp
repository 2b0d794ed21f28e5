#pragma once

#include <cardiac/anatomy/control_nodes.hpp>
#include <cardiac/heart/beat.hpp>
#include <cardiac/heart/beat_result.hpp>

namespace cardiac {

/// Indices of end diastole and end systole in the steps of a path: the last sample of filling and the last
/// sample of ejection by the valves; without circulation the first and the last state.
struct KeySteps {
  std::size_t ed = 0, es = 0;
  std::vector<Phase> phases;  ///< of every step; empty without circulation
};
KeySteps key_steps(const HeartPath& path, const Protocol& protocol);
/// The same of the right ventricle, by its own valves; only with two ventricles.
KeySteps right_key_steps(const HeartPath& path, const Protocol& protocol);

/// A node for the affine map of every AHA segment: its control node where the protocol's frames belong to the
/// segments, otherwise the one it would have then.
std::vector<ControlNode> segment_nodes(const Anatomy& anatomy, const Protocol& protocol);

/// What a path means in segments, volumes and pressures, with nodes from segment_nodes. Strains, affine maps
/// and contours are against end diastole (without a beat: the first state). Wall times, plan and protocol
/// warnings are the caller's.
BeatResult describe_path(const Ventricle& ventricle, const std::vector<ControlNode>& nodes,
                         const Protocol& protocol, const HeartPath& path);

}  // namespace cardiac
