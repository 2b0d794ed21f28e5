#pragma once

#include <cardiac/protocol/protocol.hpp>
#include <cardiac/report/figures.hpp>
#include <cardiac/run/result.hpp>

namespace cardiac::app {

/// wall.svg: the septal half of the wall at end diastole and end systole (without a beat: at the start and
/// the end), coloured by the circumferential strain of its segments. `path` has at least one step.
Figure wall_figure(const Ventricle& ventricle, const Protocol& protocol, const HeartPath& path,
                   const BeatResult& result);

}  // namespace cardiac::app
