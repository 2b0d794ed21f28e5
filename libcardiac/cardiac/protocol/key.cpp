#include <algorithm>
#include <charconv>
#include <cmath>

#include <cardiac/protocol/key.hpp>

namespace cardiac::protocol {
namespace {

bool in_range(const Range& range, double value) {
  return std::isfinite(value) && value <= range.high &&
         (range.without_low ? value > range.low : value >= range.low);
}

bool acceptable_number(const Key& key, const Json& value, bool whole) {
  const bool typed = whole ? value.is_number_integer() : value.is_number();
  return typed && in_range(key.facts.range, value.get<double>());
}

bool is_vector(const Key& key, const Json& value) {
  return value.is_array() && value.size() == 3 &&
         std::ranges::all_of(value, [&](const Json& entry) { return acceptable_number(key, entry, false); });
}

std::string in_unit(const Key& key) {
  return key.facts.unit.empty() ? "" : " in " + key.facts.unit;
}

std::string type_text(const Key& key) {
  switch (key.kind) {
    case Kind::number:
      return "a number" + in_unit(key);
    case Kind::whole:
      return "a whole number" + in_unit(key);
    case Kind::flag:
      return "true or false";
    case Kind::text:
      return "a text in quotes";
    case Kind::numbers:
      return "a list of numbers" + in_unit(key);
    case Kind::wholes:
      return "a list of whole numbers" + in_unit(key);
    case Kind::texts:
      return "a list of texts in quotes";
    case Kind::labels:
      return "a label (a whole number, or a name in quotes) or a list of labels";
    case Kind::vector:
      return "a vector of three numbers" + in_unit(key);
    case Kind::vectors:
      return "a list of vectors of three numbers" + in_unit(key);
    case Kind::choice:
      break;
  }
  std::string text = key.choices.size() > 1 ? "one of " : "";
  for (std::size_t i = 0; i < key.choices.size(); ++i) text += (i ? ", \"" : "\"") + key.choices[i] + '"';
  return text;
}

}  // namespace

const std::vector<Table>& tables() {
  static const std::vector<Table> all = [] {
    std::vector<Table> list = heart_tables();
    for (auto* more : {&model_tables, &beat_tables})
      for (auto& table : more()) list.push_back(std::move(table));
    return list;
  }();
  return all;
}

const Table* find_table(const std::string& name) {
  const auto found = std::ranges::find(tables(), name, &Table::name);
  return found == tables().end() ? nullptr : &*found;
}

const Key* find_key(const Table& table, const std::string& name) {
  const auto found = std::ranges::find(table.keys, name, &Key::name);
  return found == table.keys.end() ? nullptr : &*found;
}

namespace {

bool used_with_holds(const Table& table, const Key& key, const Protocol& protocol, std::size_t entry) {
  const std::string& with = key.facts.used_with;
  if (with.empty()) return true;
  const std::size_t dot = with.find('.');
  const Json decisive =
      dot == std::string::npos
          ? find_key(table, with)->get(protocol, entry)
          : find_key(*find_table(with.substr(0, dot)), with.substr(dot + 1))->get(protocol, 0);
  if (key.facts.used_values.empty()) return !decisive.is_null();
  return decisive.is_string() &&
         std::ranges::find(key.facts.used_values, decisive.get<std::string>()) != key.facts.used_values.end();
}

std::string used_with_text(const Table& table, const Key& key) {
  const std::string& with = key.facts.used_with;
  std::string text = with.empty() || with.find('.') != std::string::npos ? with : table.name + '.' + with;
  for (std::size_t i = 0; i < key.facts.used_values.size(); ++i) {
    text += (i ? " or " : " = ") + key.facts.used_values[i];
  }
  return text;
}

void append(std::string& text, const std::string& condition) {
  if (!condition.empty()) text += (text.empty() ? "" : ", with ") + condition;
}

}  // namespace

bool plays_a_part(const Table& table, const Key& key, const Protocol& protocol, std::size_t entry) {
  return unmet_text(table, key, protocol, entry).empty();
}

std::string unmet_text(const Table& table, const Key& key, const Protocol& protocol, std::size_t entry) {
  std::string text;
  if (!used_with_holds(table, key, protocol, entry)) append(text, used_with_text(table, key));
  for (const Condition& condition : key.facts.also)
    if (!condition.holds(protocol, entry)) append(text, condition.text);
  return text;
}

std::string condition_text(const Table& table, const Key& key) {
  std::string text = used_with_text(table, key);
  for (const Condition& condition : key.facts.also) append(text, condition.text);
  return text;
}

Protocol default_protocol() {
  Protocol protocol;
  for (const Table& table : tables()) table.open(protocol, 0);
  return protocol;
}

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const double size = std::abs(value);
  const bool plain = size == 0 || (size >= 1e-4 && size < 1e9);
  const auto format = plain ? std::chars_format::fixed : std::chars_format::general;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format).ptr;
  return {buffer.data(), end};
}

std::string range_text(const Key& key) {
  const Range& range = key.facts.range;
  std::string text;
  if (std::isfinite(range.low)) text = (range.without_low ? "above " : "at least ") + number_text(range.low);
  if (std::isfinite(range.high)) text += (text.empty() ? "at most " : ", at most ") + number_text(range.high);
  if (!text.empty() && !key.facts.unit.empty()) text += ' ' + key.facts.unit;
  return text;
}

std::string expectation(const Key& key) {
  const bool list = key.kind == Kind::numbers || key.kind == Kind::wholes || key.kind == Kind::labels;
  const std::string range = range_text(key);
  return type_text(key) + (range.empty() ? "" : (list ? ", each " : ", ") + range);
}

bool acceptable(const Key& key, const Json& value) {
  const auto each = [&](auto&& entry_acceptable) {
    return value.is_array() && std::ranges::all_of(value, entry_acceptable);
  };
  switch (key.kind) {
    case Kind::number:
      return acceptable_number(key, value, false);
    case Kind::whole:
      return acceptable_number(key, value, true);
    case Kind::flag:
      return value.is_boolean();
    case Kind::text:
      return value.is_string();
    case Kind::choice:
      return value.is_string() &&
             std::ranges::find(key.choices, value.get<std::string>()) != key.choices.end();
    case Kind::numbers:
      return each([&](const Json& entry) { return acceptable_number(key, entry, false); });
    case Kind::wholes:
      return each([&](const Json& entry) { return acceptable_number(key, entry, true); });
    case Kind::texts:
      return each([](const Json& entry) { return entry.is_string(); });
    case Kind::labels: {
      const auto label = [&](const Json& entry) {
        return entry.is_string() || acceptable_number(key, entry, true);
      };
      return value.is_array() ? !value.empty() && each(label) : label(value);
    }
    case Kind::vector:
      return is_vector(key, value);
    case Kind::vectors:
      return each([&](const Json& entry) { return is_vector(key, entry); });
  }
  return false;
}

}  // namespace cardiac::protocol
