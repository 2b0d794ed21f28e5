#pragma once

#include <memory>
#include <vector>

#include <cardiac/reduction/segment_frames.hpp>

#include "support/land_ellipsoid.hpp"

namespace cardiac::testing {

/// Frames of AHA's layout on the coarse mesh of Land's ellipsoid, with base frames.
inline std::shared_ptr<const SegmentFrames> aha_frames() {
  const auto& land = LandEllipsoid::get();
  return std::make_shared<SegmentFrames>(land.coordinates, frame_layout(land.mesh, *land.coordinates), true);
}

/// 1 for each of these segments, 0 for the others.
inline std::vector<int> kinds_of(const std::vector<int>& segments) {
  std::vector<int> out(kBothSegments, 0);
  for (const int s : segments) out[s - 1] = 1;
  return out;
}

}  // namespace cardiac::testing
