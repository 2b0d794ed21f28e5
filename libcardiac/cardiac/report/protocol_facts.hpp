#pragma once

#include <string>
#include <vector>

#include <cardiac/report/bullseye.hpp>

namespace cardiac {

/// The [[region]] tables of a resolved protocol (JSON) that have segments, those without a name by their
/// number. What is not of that form is left out.
std::vector<NamedRegion> regions_of(const std::string& protocol_json);

/// What a run takes for granted of its mesh and supports, as sentences for its reader: stress-free shape,
/// base, outer wall, long axis and anterior direction.
std::vector<std::string> assumptions_of(const std::string& protocol_json, bool right_ventricle);

}  // namespace cardiac
