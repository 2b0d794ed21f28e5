#pragma once

#include <cardiac/model/ventricle.hpp>
#include <cardiac/run/beat.hpp>

namespace cardiac {

/// Active tension (kPa) of all integration points of a wall in a state of a path; empty without contraction.
polyaffine::Vector active_tension(const Ventricle& wall, const HeartPath& path, const HeartState& state);

}  // namespace cardiac
