#pragma once

#include <vector>

#include <cardiac/run/result.hpp>

namespace cardiac {

/// What a run came to: the model that its path was computed with, the nodes of the segments, the path and
/// what it means. Why it stopped is a value (BeatResult::completed, stop_reason).
struct Outcome {
  Ventricle model;
  std::vector<ControlNode> nodes;
  HeartPath path;
  BeatResult result;
};

/// Computes a scene: beats where it has a circulation (run_beats), else the loading and contraction under its
/// pressures (run_prescribed). Of a heart that was imaged under pressure the stress-free shape is found first
/// (unload), and everything is computed on that: it is the anatomy of the model. A path by trained
/// integration points that are not to be trusted (distrust) is computed anew with all points, and a result
/// that is absurd is not a completed one. Throws InputError as build_ventricle and for a scene without a
/// heart; ComputationError as unload.
Outcome simulate(const Scene& scene, const RunControl& control = {});

}  // namespace cardiac
