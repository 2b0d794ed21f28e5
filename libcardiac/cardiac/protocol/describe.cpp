#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include <cardiac/protocol/describe.hpp>
#include <cardiac/protocol/key.hpp>
#include <cardiac/protocol/nearest_key.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

using namespace protocol;

Json number_schema(const Key& key, const char* type) {
  Json schema = {{"type", type}};
  const Range& range = key.facts.range;
  if (std::isfinite(range.low)) schema[range.without_low ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) schema["maximum"] = range.high;
  return schema;
}

Json list_of(Json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}

Json type_schema(const Key& key) {
  const auto vector = [&] {
    Json schema = list_of(number_schema(key, "number"));
    schema["minItems"] = schema["maxItems"] = 3;
    return schema;
  };
  switch (key.kind) {
    case Kind::number:
      return number_schema(key, "number");
    case Kind::whole:
      return number_schema(key, "integer");
    case Kind::flag:
      return {{"type", "boolean"}};
    case Kind::text:
      return {{"type", "string"}};
    case Kind::choice:
      return {{"type", "string"}, {"enum", key.choices}};
    case Kind::numbers:
      return list_of(number_schema(key, "number"));
    case Kind::wholes:
      return list_of(number_schema(key, "integer"));
    case Kind::texts:
      return list_of({{"type", "string"}});
    case Kind::labels: {
      const Json label = {{"anyOf", {number_schema(key, "integer"), {{"type", "string"}}}}};
      return {{"anyOf", {label, list_of(label)}}};
    }
    case Kind::vector:
      return vector();
    case Kind::vectors:
      return list_of(vector());
  }
  return {};
}

/// Null for a key that is required or has none.
Json default_of(const Key& key) {
  return key.facts.required ? Json() : key.get(default_protocol(), 0);
}

Json key_schema(const Table& table, const Key& key) {
  Json schema = type_schema(key);
  const std::string condition = condition_text(table, key);
  schema["description"] = key.facts.meaning + (condition.empty() ? "" : " (goes with " + condition + ")");
  if (!key.facts.unit.empty()) schema["unit"] = key.facts.unit;
  if (!key.facts.source.empty()) schema["source"] = key.facts.source;
  if (const Json value = default_of(key); !value.is_null()) schema["default"] = value;
  return schema;
}

Json table_schema(const Table& table) {
  Json schema = {{"type", "object"},
                 {"description", table.meaning},
                 {"properties", Json::object()},
                 {"additionalProperties", false}};
  for (const Key& key : table.keys) {
    schema["properties"][key.name] = key_schema(table, key);
    if (key.facts.required && key.facts.instead.empty()) schema["required"].push_back(key.name);
  }
  return table.list ? list_of(std::move(schema)) : schema;
}

std::string line(const std::string& word, const std::string& text) {
  return text.empty() ? "" : "  " + word + std::string(10 - word.size(), ' ') + text + '\n';
}

std::string value_text(const Json& value) {
  return value.is_number_float() ? number_text(value.get<double>()) : value.dump();
}

std::string explain_key(const Table& table, const Key& key) {
  const Json value = default_of(key);
  const std::string unit = key.facts.unit.empty() ? "" : ' ' + key.facts.unit;
  std::string standard = value.is_null() ? "none" : value_text(value) + (value.is_number() ? unit : "");
  if (value.is_null() && !key.facts.absent.empty()) standard += ": " + key.facts.absent;
  if (key.facts.required) standard = "none: the key is required";
  const bool number = key.kind != Kind::flag && key.kind != Kind::text && key.kind != Kind::texts &&
                      key.kind != Kind::labels && key.kind != Kind::choice;
  return table.name + '.' + key.name + '\n' + line("meaning", key.facts.meaning) +
         line("expected", expectation(key)) +
         line("unit", number && key.facts.unit.empty() ? "dimensionless" : key.facts.unit) +
         line("default", standard) + line("range", range_text(key)) +
         line("goes with", condition_text(table, key)) + line("source", key.facts.source);
}

std::string header(const Table& table) {
  return table.list ? "[[" + table.name + "]]" : '[' + table.name + ']';
}

std::string explain_tables() {
  std::size_t width = 0;
  for (const Table& table : tables()) width = std::max(width, header(table).size());
  std::string text = "Tables of a protocol; `cardiac explain TABLE` lists the keys of one:\n";
  for (const Table& table : tables()) {
    text += "  " + header(table) + std::string(width + 2 - header(table).size(), ' ') + table.meaning + '\n';
  }
  return text;
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// All that a search looks at.
std::string searched(const Table& table, const Key& key) {
  std::string text = table.name + '.' + key.name + '\n' + key.facts.meaning + '\n' + key.facts.absent + '\n' +
                     key.facts.source + '\n' + condition_text(table, key);
  for (const std::string& choice : key.choices) text += '\n' + choice;
  return lower(text);
}

/// The keys that hold all words; empty when there is none.
std::string explain_matches(const std::string& words) {
  std::vector<std::pair<const Table*, const Key*>> found;
  std::size_t width = 0;
  for (const Table& table : tables()) {
    for (const Key& key : table.keys) {
      const std::string text = searched(table, key);
      std::istringstream list(lower(words));
      const bool all =
          std::all_of(std::istream_iterator<std::string>(list), std::istream_iterator<std::string>(),
                      [&](const std::string& word) { return text.find(word) != std::string::npos; });
      if (!all) continue;
      found.emplace_back(&table, &key);
      width = std::max(width, table.name.size() + 1 + key.name.size());
    }
  }
  if (found.size() == 1) return explain_key(*found[0].first, *found[0].second);
  std::string text;
  for (const auto& [table, key] : found) {
    const std::string path = table->name + '.' + key->name;
    text += path + std::string(width + 2 - path.size(), ' ') + key->facts.meaning + '\n';
  }
  return text;
}

std::string explain_table(const Table& table) {
  std::size_t width = 0;
  for (const Key& key : table.keys) width = std::max(width, key.name.size());
  std::string text = header(table) + "  " + table.meaning + '\n';
  if (table.optional) text += "  Left out: not built.\n";
  for (const Key& key : table.keys) {
    text += "  " + key.name + std::string(width + 2 - key.name.size(), ' ') + key.facts.meaning + '\n';
  }
  return text;
}

}  // namespace

Json protocol_schema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "cardiac protocol"},
                 {"type", "object"},
                 {"properties", Json::object()},
                 {"required", Json::array()},
                 {"additionalProperties", false}};
  for (const Table& table : tables()) {
    const auto dot = table.name.find('.');
    Json& parent = dot == std::string::npos ? schema : schema["properties"][table.name.substr(0, dot)];
    parent["properties"][table.name.substr(dot + 1)] = table_schema(table);
    if (table.required) schema["required"].push_back(table.name);
  }
  return schema;
}

Json resolved_json(const Protocol& protocol) {
  Json resolved = Json::object();
  for (const Table& table : tables()) {
    Json entries = Json::array();
    for (std::size_t index = 0; index < table.count(protocol); ++index) {
      Json entry = Json::object();
      for (const Key& key : table.keys) {
        const Json value = key.get(protocol, index);
        if (!value.is_null() && plays_a_part(table, key, protocol, index)) entry[key.name] = value;
      }
      entries.push_back(std::move(entry));
    }
    if (entries.empty()) continue;
    const auto dot = table.name.find('.');
    Json& parent = dot == std::string::npos ? resolved : resolved[table.name.substr(0, dot)];
    parent[table.name.substr(dot + 1)] = table.list ? entries : entries[0];
  }
  return resolved;
}

std::string explain(const std::string& words) {
  if (words.find_first_not_of(' ') == std::string::npos) return explain_tables();
  if (const Table* table = find_table(words)) return explain_table(*table);
  const auto dot = words.rfind('.');
  const std::string first = words.substr(0, dot);
  if (dot == std::string::npos) {
    std::string text;
    for (const Table& table : tables()) {
      if (const Key* key = find_key(table, first)) text += explain_key(table, *key);
    }
    if (!text.empty()) return text;
  } else if (const Table* table = find_table(first)) {
    if (const Key* key = find_key(*table, words.substr(dot + 1))) return explain_key(*table, *key);
  }
  // Behind a known table stands the name of a key, not words.
  const bool key_path = dot != std::string::npos && find_table(first) != nullptr;
  if (const std::string found = key_path ? "" : explain_matches(words); !found.empty()) return found;
  const std::string nearest =
      dot == std::string::npos ? nearest_key("", words) : nearest_key(first, words.substr(dot + 1));
  throw polyaffine::InputError(words + ": unknown key; the nearest known key is " + nearest);
}

std::vector<std::string> key_paths() {
  std::vector<std::string> paths;
  for (const Table& table : tables()) {
    for (const Key& key : table.keys) paths.push_back(table.name + '.' + key.name);
  }
  return paths;
}

}  // namespace cardiac
