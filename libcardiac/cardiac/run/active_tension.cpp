#include "cardiac/run/active_tension.hpp"

namespace cardiac {

polyaffine::Vector active_tension(const Ventricle& wall, const HeartPath& path, const HeartState& state) {
  if (wall.muscle) return state.tension_kPa;
  if (!wall.contraction) return {};
  return wall.contraction->tension(path.beat_start_ms + state.time_ms);
}

}  // namespace cardiac
