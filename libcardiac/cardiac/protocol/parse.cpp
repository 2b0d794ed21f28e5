#include <algorithm>
#include <cstdint>
#include <fstream>
#include <sstream>

#include <cardiac/protocol/build_network.hpp>
#include <cardiac/protocol/entries.hpp>
#include <cardiac/protocol/given_files.hpp>
#include <cardiac/protocol/key.hpp>
#include <cardiac/protocol/nearest_key.hpp>
#include <cardiac/protocol/rules.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

using namespace protocol;
using polyaffine::InputError;

std::string path_of(const Entry& entry) {
  return key_path(entry.table, entry.index, entry.key);
}

/// A list given by an override replaces the list of the file; single keys replace single keys.
void merge(std::vector<Entry>& entries, std::vector<Entry> overrides) {
  for (const Entry& entry : overrides) {
    const Table* table = find_table(entry.table);
    if (table != nullptr && table->list && entry.key.empty() && entry.index == 0) {
      std::erase_if(entries, [&](const Entry& other) { return other.table == entry.table; });
    }
  }
  for (Entry& entry : overrides) {
    const auto same = std::ranges::find_if(entries, [&](const Entry& e) { return e.same_place(entry); });
    if (same == entries.end()) {
      entries.push_back(std::move(entry));
    } else if (!entry.key.empty()) {
      *same = std::move(entry);
    }
  }
}

/// The path that leads from `directory`, the protocol's, to the file that `word` names from the current
/// folder; an absolute path as it is.
std::string from_directory(const std::string& word, const std::filesystem::path& directory) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path current = fs::current_path(error);
  if (error || word.empty() || fs::path(word).is_absolute()) return word;
  const fs::path folder = (current / directory).lexically_normal();
  return (current / word).lexically_normal().lexically_proximate(folder).string();
}

/// An override is typed in a shell, whose folder its relative paths start at.
std::vector<Entry> from_shell(std::vector<Entry> overrides, const std::filesystem::path& directory) {
  for (Entry& entry : overrides) {
    const Table* table = find_table(entry.table);
    const Key* key = table == nullptr ? nullptr : find_key(*table, entry.key);
    if (key == nullptr || !key->facts.path) continue;
    if (entry.value.is_string())
      entry.value = from_directory(entry.value.get<std::string>(), directory);
    else if (entry.value.is_array())
      for (Json& one : entry.value) {
        if (!one.is_string()) continue;
        const auto word = one.get<std::string>();  // FILE or NAME=FILE
        const std::string name = word.substr(0, word.find('=') == std::string::npos ? 0 : word.find('=') + 1);
        one = name + from_directory(word.substr(name.size()), directory);
      }
  }
  return overrides;
}

[[noreturn]] void fail_unknown(const Entry& entry) {
  const std::string nearest = nearest_key(entry.table, entry.key);
  const bool unit_left_out = nearest.find('.' + entry.key + '_') != std::string::npos;
  throw InputError(entry.where + ": " + path_of(entry) + ": unknown key; the nearest known key is " +
                   nearest + (unit_left_out ? " (the unit is part of the name)" : ""));
}

// More than any protocol needs, and few enough for the checks to take no time.
constexpr std::uintmax_t kMostBytes = 1 << 20;
constexpr std::size_t kMostListEntries = 100;

void assign(Protocol& protocol, const Entry& entry) {
  const Table* table = find_table(entry.table.empty() ? entry.key : entry.table);
  if (entry.table.empty() && table != nullptr) {
    const std::string brackets = table->list ? "[[" + entry.key + "]]" : '[' + entry.key + ']';
    throw InputError(entry.where + ": " + entry.key + ": found " + entry.found + ", expected a table " +
                     brackets);
  }
  if (table == nullptr) {
    if (entry.table.empty() || !entry.key.empty()) fail_unknown(entry);
    throw InputError(entry.where + ": " + entry.table + ": unknown table; the nearest known table is " +
                     nearest_table(entry.table));
  }
  if (entry.index >= kMostListEntries) {
    throw InputError(entry.where + ": " + entry.table + ": found more than " +
                     std::to_string(kMostListEntries) + " entries [[" + table->name + "]]");
  }
  if (entry.key.empty()) return entry.value.is_array() ? void() : table->open(protocol, entry.index);
  const Key* key = find_key(*table, entry.key);
  if (key == nullptr) fail_unknown(entry);
  if (!acceptable(*key, entry.value)) {
    throw InputError(entry.where + ": " + path_of(entry) + ": found " + entry.found + ", expected " +
                     expectation(*key));
  }
  if (table->list && entry.index >= table->count(protocol)) {
    throw InputError(entry.where + ": " + path_of(entry) + ": there are only " +
                     std::to_string(table->count(protocol)) + " entries [[" + table->name + "]]");
  }
  key->set(protocol, entry.index, entry.value);
}

void check_required(const Protocol& protocol, const std::vector<Entry>& entries, const std::string& source) {
  for (const Table& table : tables()) {
    for (std::size_t index = 0; index < table.count(protocol); ++index) {
      for (const Key& key : table.keys) {
        const Entry wanted{table.name, index, key.name, {}, {}, {}};
        const Entry header{table.name, index, "", {}, {}, {}};
        const auto given = [&](const Entry& place) {
          return std::ranges::find_if(entries, [&](const Entry& e) { return e.same_place(place); });
        };
        const bool other = std::ranges::any_of(key.facts.instead, [&](const std::string& name) {
          return given({table.name, index, name, {}, {}, {}}) != entries.end();
        });
        if (!key.facts.required || other || given(wanted) != entries.end()) continue;
        const auto place = given(header);
        throw InputError((place == entries.end() ? source : place->where) + ": " +
                         key_path(table.name, index, key.name) + ": missing; expected " + expectation(key));
      }
    }
  }
}

void warn_of_unused(Protocol& protocol, const std::vector<Entry>& entries) {
  for (const Entry& entry : entries) {
    if (entry.key.empty()) continue;
    const Table& table = *find_table(entry.table);
    const Key& key = *find_key(table, entry.key);
    const std::string unmet = unmet_text(table, key, protocol, entry.index);
    if (unmet.empty()) continue;
    protocol.warnings.push_back(entry.where + ": " + path_of(entry) + " plays no part: it goes with " +
                                unmet);
  }
}

Place place_in(const std::vector<Entry>& entries, const std::string& source) {
  return [&entries, source](const std::string& path) {
    const auto given =
        std::ranges::find_if(entries, [&](const Entry& entry) { return path_of(entry) == path; });
    return given == entries.end() ? source : given->where;
  };
}

}  // namespace

std::filesystem::path mesh_path(const Protocol& protocol) {
  return (protocol.directory / protocol.mesh.file.value()).lexically_normal();
}

std::filesystem::path surface_path(const Protocol& protocol) {
  return (protocol.directory / protocol.mesh.surface_file.value()).lexically_normal();
}

void check_mesh_file(const Protocol& protocol) {
  if (protocol.mesh.file && !std::filesystem::is_regular_file(mesh_path(protocol))) {
    throw InputError(
        "mesh.file: no such file " + mesh_path(protocol).string() +
        "; expected a tetrahedral mesh, its path relative to the protocol file (in --set: to the "
        "current folder)");
  }
  if (protocol.mesh.file && protocol.mesh.surface_file &&
      !std::filesystem::is_regular_file(surface_path(protocol))) {
    throw InputError(
        "mesh.surface_file: no such file " + surface_path(protocol).string() +
        "; expected labelled triangles, its path relative to the protocol file (in --set: to the "
        "current folder)");
  }
}

Protocol parse_protocol(const std::string& text, const std::filesystem::path& source,
                        const std::vector<std::string>& overrides) {
  std::vector<Entry> entries = read_entries(text, source.string());
  for (const std::string& assignment : overrides)
    merge(entries, from_shell(read_override(assignment), source.parent_path()));

  Protocol protocol;
  protocol.directory = source.parent_path();
  for (const Entry& entry : entries) assign(protocol, entry);
  check_required(protocol, entries, source.string());
  const Place place = place_in(entries, source.string());
  fill_scheme(protocol);
  check_rules(protocol, place);
  if (const double left = protocol.mesh.pressure_kPa.value_or(0),
      right = protocol.mesh.pressure_kPa ? protocol.mesh.right_pressure_kPa.value_or(0) : 0;
      left > 0 || right > 0)
    protocol.imaged = ImagedUnder{left, right};
  build_network(protocol, place);
  read_given_files(protocol, place);
  fill_presets(protocol, protocol.anatomy.scheme == Scheme::aha29);
  const Entry local{"reduction", 0, "local_bulk_modulus_kPa", {}, {}, {}};
  if (std::ranges::none_of(entries, [&](const Entry& entry) { return entry.same_place(local); }))
    raise_local_bulk_modulus(protocol.anatomy.scheme == Scheme::aha29, protocol);
  warn_of_limits(protocol, place);
  warn_of_unused(protocol, entries);
  return protocol;
}

Protocol load_protocol(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  if (!std::filesystem::is_regular_file(file)) {
    throw InputError(file.string() + ": no such file; expected a protocol (.toml)");
  }
  if (file.extension() != ".toml") {
    throw InputError(file.string() + ": found the extension \"" + file.extension().string() +
                     "\", expected a protocol with the extension .toml");
  }
  if (const auto bytes = std::filesystem::file_size(file); bytes > kMostBytes) {
    throw InputError(file.string() + ": found " + std::to_string(bytes) +
                     " bytes, expected a protocol of at most " + std::to_string(kMostBytes));
  }
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError(file.string() + ": cannot be read");
  return parse_protocol(text.str(), file, overrides);
}

}  // namespace cardiac
