#pragma once

#include <cardiac/protocol/protocol.hpp>
#include <cardiac/protocol/rules.hpp>

namespace cardiac::protocol {

/// The circulation's network that the compartments and elements of a protocol make, or that its file of
/// svZeroDSolver tells; nothing for other loops. Throws polyaffine::InputError naming the entry or the file
/// and what is wrong with it.
void build_network(Protocol& protocol, const Place& place);

}  // namespace cardiac::protocol
