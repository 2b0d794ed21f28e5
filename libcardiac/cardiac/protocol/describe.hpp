#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include <cardiac/protocol/protocol.hpp>

namespace cardiac {

/// JSON schema (draft 2020-12) of a protocol: one property a key, with type, range, default and, beside the
/// standard words, "unit" and "source". Unknown properties are not allowed.
nlohmann::json protocol_schema();

/// The protocol with every default filled in: the tables that are present, without the keys that play no
/// part. Each table reads back as the same protocol.
nlohmann::json resolved_json(const Protocol& protocol);

/// Meaning, type, unit, default, range and source of a key (`table.key`, or the key alone); the keys of a
/// table for its name; for other words the keys whose name, meaning, choices or source hold all of them (a
/// single one explained), the tables for none. Throws polyaffine::InputError that names the nearest key where
/// nothing fits.
std::string explain(const std::string& words);

/// Paths of all keys, in the order of the protocol file.
std::vector<std::string> key_paths();

}  // namespace cardiac
