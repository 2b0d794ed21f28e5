#pragma once

#include <cardiac/protocol/protocol.hpp>
#include <cardiac/protocol/rules.hpp>

namespace cardiac::protocol {

/// Reads the tables that a protocol names into its scene: pressures or volumes of the cavities
/// (cavities.pressure_file, volume_file), tension (contraction.tension_file), activation times at points
/// (activation.times_file). Throws polyaffine::InputError naming file, line and column, what was found, what
/// was expected and the unit.
void read_given_files(Protocol& protocol, const Place& place);

}  // namespace cardiac::protocol
