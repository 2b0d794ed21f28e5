#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// The text of a protocol, flattened: the only place that knows TOML. For the sources of this folder only.
namespace cardiac::protocol {

/// One value, or the bare presence of a table (key empty; with an empty array as value: a list without
/// tables).
struct Entry {
  std::string table;      ///< empty: a value outside any table
  std::size_t index = 0;  ///< entry of a list of tables, from 0
  std::string key;
  nlohmann::json value;  ///< null where JSON has no such type (dates)
  std::string found;     ///< the value in words, for messages
  std::string where;     ///< "file:line", or the option that gave it

  bool same_place(const Entry& other) const {
    return table == other.table && index == other.index && key == other.key;
  }
};

/// The entries of a TOML text; `source` stands for the file in messages. Throws polyaffine::InputError where
/// the text is not TOML.
std::vector<Entry> read_entries(const std::string& text, const std::string& source);

/// The entries of one `key.path=value`, value in TOML or a bare word; an entry of a list of tables is counted
/// from 1 (region.1.tension_factor=0).
std::vector<Entry> read_override(const std::string& assignment);

}  // namespace cardiac::protocol
