#pragma once

#include <vector>

#include <cardiac/core/beat_result.hpp>
#include <cardiac/protocol/protocol.hpp>

namespace cardiac {

/// What a run of the protocol builds and what it leaves out, each with the reason. Parts in the order in
/// which they are built: mesh, coordinates, segments, fibres, activation, contraction, cavity, circulation,
/// regions, reduction, full order, verification, tables, figures, mesh series. `verify`: the full order is
/// solved beside the reduced model at end diastole and end systole.
std::vector<PlanItem> plan(const Protocol& protocol, bool verify = false);

/// Does the plan build the part of this name? Throws std::out_of_range for a name that is not in it.
bool builds(const std::vector<PlanItem>& items, const std::string& part);

}  // namespace cardiac
