#pragma once

#include <cstddef>
#include <string>

namespace cardiac::protocol {

/// Fewest insertions, deletions and replacements of one character that turn one word into the other, case
/// ignored (Levenshtein 1966).
int edit_distance(const std::string& one, const std::string& other);

/// Path of the known key or table that is nearest to `table.key` ("" for a table: a key outside any table). A
/// key of the same table goes before one of another; a key that begins with the same word (its unit left out)
/// is near.
std::string nearest_key(const std::string& table, const std::string& key);

std::string nearest_table(const std::string& name);

/// Path of a key in messages: table.key, or table.3.key for the third entry of a list of tables.
std::string key_path(const std::string& table, std::size_t index, const std::string& key);

}  // namespace cardiac::protocol
