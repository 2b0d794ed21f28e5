#pragma once

#include <functional>
#include <string>

#include <cardiac/protocol/protocol.hpp>
#include <cardiac/scene/presets.hpp>

namespace cardiac::protocol {

/// Where a key was given ("file:12"), or where it could be ("file") when it was not; for messages.
using Place = std::function<std::string(const std::string& path)>;

/// The scheme that the file does not name: that of the shape; aha17 for a mesh file, said in
/// Protocol::scheme_assumed.
void fill_scheme(Protocol& protocol);

/// Adds warnings about values that are allowed and lead beyond what the reduced model can tell.
void warn_of_limits(Protocol& protocol, const Place& place);

/// What a single key cannot tell: keys that need, exclude or contradict one another. Throws
/// polyaffine::InputError at the first violation.
void check_rules(const Protocol& protocol, const Place& place);

/// Does the passive law, the contraction or the conduction depend on the direction of the fibres?
bool needs_fibres(const Protocol& protocol);
std::string why_fibres(const Protocol& protocol);

}  // namespace cardiac::protocol
