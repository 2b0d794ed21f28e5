#include "cardiac/reduction/frame_functions.hpp"

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/reduction/global_frame.hpp>

namespace cardiac {
namespace {

std::string monomial_name(const polyaffine::Monomial& m) {
  std::string out;
  for (int k = 0; k < 3; ++k) out += std::string(m[k], "lct"[k]);
  return out.empty() ? "1" : out;
}

std::string frame_name(const Discretisation& d, int frame) {
  const FrameLayout& layout = d.layout;
  const int nodes = layout.num_nodes();
  if (dynamic_cast<const GlobalFrame*>(&d.frame_basis->field()) &&
      frame + 1 == d.frame_basis->field().num_frames())
    return "whole heart";
  if (frame >= nodes) {
    const int base = d.frames && d.frames->base_frames() ? layout.rings.back().nodes : 0;
    return frame < nodes + base ? "base " + std::to_string(frame - nodes + 1)
                                : "border " + std::to_string(frame - nodes - base + 1);
  }
  if (layout.follows_segments) return aha_name(frame + 1);
  if (frame == layout.cap()) return "cap";
  if (frame > layout.cap()) return "right " + std::to_string(frame - layout.cap());
  std::size_t ring = 0;
  while (frame < layout.rings[ring].first_frame ||
         frame >= layout.rings[ring].first_frame + layout.rings[ring].nodes)
    ++ring;
  return "ring " + std::to_string(ring + 1) + " node " +
         std::to_string(frame - layout.rings[ring].first_frame + 1);
}

}  // namespace

std::vector<FrameFunction> frame_functions(const Discretisation& d) {
  std::vector<FrameFunction> out;
  if (!d.frame_basis) return out;
  const auto& frames = d.frame_basis->frames();
  for (int i = 0; i < static_cast<int>(frames.size()); ++i)
    for (const auto& m : frames[i].monomials)
      out.push_back({frame_name(d, i), monomial_name(m), frames[i].local_axes});
  return out;
}

}  // namespace cardiac
