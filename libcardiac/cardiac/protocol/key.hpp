#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <cardiac/protocol/protocol.hpp>

/// The key table: the one description from which parsing, range checks, defaults, the schema, the
/// explanations and the resolved protocol are made. For the sources of this folder only (it needs the JSON
/// library).
namespace cardiac::protocol {

using Json = nlohmann::json;

enum class Kind { number, whole, flag, text, choice, numbers, wholes, texts, labels, vector, vectors };

/// Allowed values, or entries of a list.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool without_low = false;  ///< low itself is not allowed
};
/// Above zero, at most `high`.
inline Range above_zero(double high) {
  return {0, high, true};
}

/// A circumstance without which a key plays no part, in words and as a test of a protocol (and, in a list of
/// tables, of the entry).
struct Condition {
  std::string text;
  std::function<bool(const Protocol&, std::size_t entry)> holds;
};

/// What a row of the table says of a key, apart from its name and the member it fills.
struct KeyFacts {
  std::string unit = {};  ///< empty: dimensionless
  Range range = {};
  std::string meaning = {};  ///< formula included where there is one
  std::string source = {};   ///< where the default comes from
  std::string absent = {};   ///< what happens without the key, where there is no default
  bool required = false;
  std::vector<std::string> instead = {};  ///< keys of its table any of which makes a required one needless
  std::string used_with =
      {};  ///< key that decides whether this one plays a part: of its table, or "table.key"
  std::vector<std::string> used_values = {};  ///< with these values; empty: when it is given at all
  bool path = false;                          ///< a file: relative to the folder of what names it
  std::vector<Condition> also = {};           ///< and under all of these conditions
};

struct Key {
  std::string name;
  Kind kind;
  std::vector<std::string> choices;
  KeyFacts facts;
  std::function<void(Protocol&, std::size_t, const Json&)> set;  ///< table entry, checked value
  std::function<Json(const Protocol&, std::size_t)> get;         ///< null when not set
};

struct Table {
  std::string name;
  std::string meaning;
  bool required = false;
  bool optional = false;  ///< absent means that the part is not built
  bool list = false;      ///< [[name]]: any number of entries
  std::vector<Key> keys;
  std::function<void(Protocol&, std::size_t)> open;  ///< makes the entry (a list grows to hold it)
  std::function<std::size_t(const Protocol&)> count;
};

/// All tables in the order of the protocol file.
const std::vector<Table>& tables();

/// The parts of it: the heart, its model, what it does.
std::vector<Table> heart_tables();
std::vector<Table> model_tables();
std::vector<Table> beat_tables();
Table boundary_table();
Table contraction_table();
std::vector<Table> circulation_tables();
std::vector<Table> network_tables();

/// Null when there is none.
const Table* find_table(const std::string& name);
const Key* find_key(const Table& table, const std::string& name);

/// Does the key play a part, given its used_with key (in the same entry where that is of the same table) and
/// its conditions?
bool plays_a_part(const Table& table, const Key& key, const Protocol& protocol, std::size_t entry);

/// Those of the key's conditions that the protocol does not meet, in words; empty where it plays a part.
std::string unmet_text(const Table& table, const Key& key, const Protocol& protocol, std::size_t entry);

/// The conditions under which the key plays a part, in words ("tissue.law = guccione"); empty without one.
std::string condition_text(const Table& table, const Key& key);

/// A protocol in which every table is present once and holds its defaults.
Protocol default_protocol();

/// What is expected of a value: type, unit, range, choices; for messages and explanations.
std::string expectation(const Key& key);

/// The range alone ("above 0, at most 1000 kPa"); empty without one.
std::string range_text(const Key& key);

/// Is the value of the key's type and in its range?
bool acceptable(const Key& key, const Json& value);

/// Shortest text that reads back as the same number.
std::string number_text(double value);

}  // namespace cardiac::protocol
