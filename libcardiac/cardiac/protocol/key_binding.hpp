#pragma once

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <type_traits>
#include <utility>

#include <cardiac/protocol/key.hpp>
#include <cardiac/protocol/names.hpp>

/// How a row of the key table is tied to a member of a plain struct.
namespace cardiac::protocol {

template <class T>
struct Unwrapped {
  using type = T;
  static constexpr bool optional = false;
};
template <class T>
struct Unwrapped<std::optional<T>> {
  using type = T;
  static constexpr bool optional = true;
};

template <class T>
struct IsList : std::false_type {};
template <class T>
struct IsList<std::vector<T>> : std::true_type {};

template <class T>
constexpr Kind kind_of() {
  if constexpr (std::is_enum_v<T>) return Kind::choice;
  if constexpr (std::is_same_v<T, double>) return Kind::number;
  if constexpr (std::is_same_v<T, int>) return Kind::whole;
  if constexpr (std::is_same_v<T, bool>) return Kind::flag;
  if constexpr (std::is_same_v<T, std::string>) return Kind::text;
  if constexpr (std::is_same_v<T, std::vector<double>>) return Kind::numbers;
  if constexpr (std::is_same_v<T, std::vector<int>>) return Kind::wholes;
  if constexpr (std::is_same_v<T, std::vector<std::string>>) return Kind::texts;
  if constexpr (std::is_same_v<T, Labels>) return Kind::labels;
  if constexpr (std::is_same_v<T, Vector3>) return Kind::vector;
  if constexpr (std::is_same_v<T, std::vector<Vector3>>) return Kind::vectors;
}

template <class T>
T from_json(const Json& value) {
  if constexpr (std::is_enum_v<T>) {
    const auto names = names_of(T{});
    const auto word = value.get<std::string>();
    std::size_t index = 0;
    while (names.at(index) != word) ++index;
    return static_cast<T>(index);
  } else if constexpr (std::is_same_v<T, Labels>) {
    Labels labels;
    for (const Json& entry : value.is_array() ? value : Json::array({value})) {
      if (entry.is_string())
        labels.emplace_back(entry.get<std::string>());
      else
        labels.emplace_back(entry.get<int>());
    }
    return labels;
  } else {
    return value.get<T>();
  }
}

template <class T>
Json to_json(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return name_of(value);
  } else if constexpr (std::is_same_v<T, Labels>) {
    Json list = Json::array();
    for (const auto& label : value) std::visit([&](const auto& entry) { list.push_back(entry); }, label);
    return list;
  } else {
    return value;
  }
}

/// From the unit of a key to that of the scene: scene = key · factor, or factor / key.
struct Units {
  double factor = 1;
  bool inverse = false;

  double to_scene(double value) const { return inverse ? factor / value : value * factor; }
  /// Rounded to the 15 digits that survive the way there and back.
  double to_key(double value) const {
    const double exact = inverse ? factor / value : value / factor;
    char text[32];
    std::snprintf(text, sizeof text, "%.15g", exact);
    return factor == 1 && !inverse ? value : std::strtod(text, nullptr);
  }
};

/// Builds the keys of one table whose values live in the struct S, held by Protocol plainly, as an optional
/// or as a list.
template <class Held>
class TableBuilder {
 public:
  template <class Part>
  TableBuilder(std::string name, std::string meaning, Held Part::*part) : held_(part) {
    Held Protocol::*held = part;
    table_.name = std::move(name);
    table_.meaning = std::move(meaning);
    table_.optional = Unwrapped<Held>::optional;
    table_.list = is_list;
    table_.open = [held](Protocol& protocol, std::size_t entry) { (void)opened(protocol.*held, entry); };
    table_.count = [held](const Protocol& protocol) { return count(protocol.*held); };
  }

  template <class S, class T>
  TableBuilder& key(std::string name, T S::*member, KeyFacts facts, Units units = {}) {
    using Value = typename Unwrapped<T>::type;
    Key row{std::move(name), kind_of<Value>(), {}, std::move(facts), {}, {}};
    if constexpr (std::is_enum_v<Value>) {
      for (const auto& word : names_of(Value{})) row.choices.emplace_back(word);
    }
    row.set = [held = held_, member, units](Protocol& protocol, std::size_t entry, const Json& value) {
      Value read = from_json<Value>(value);
      if constexpr (std::is_same_v<Value, double>) read = units.to_scene(read);
      opened(protocol.*held, entry).*member = std::move(read);
    };
    row.get = [held = held_, member, units](const Protocol& protocol, std::size_t entry) -> Json {
      const auto told = [&](const Value& value) -> Json {
        if constexpr (std::is_same_v<Value, double>) return units.to_key(value);
        return to_json(value);
      };
      const T& value = viewed(protocol.*held, entry).*member;
      if constexpr (Unwrapped<T>::optional) {
        return value ? told(*value) : Json();
      } else {
        return told(value);
      }
    };
    table_.keys.push_back(std::move(row));
    return *this;
  }

  /// Every key so far plays its part under this condition.
  TableBuilder& all(const Condition& condition) {
    for (Key& key : table_.keys) key.facts.also.push_back(condition);
    return *this;
  }

  Table build() { return std::move(table_); }
  Table build_required() {
    table_.required = true;
    return build();
  }

 private:
  static constexpr bool is_list = IsList<Held>::value;

  static auto& opened(Held& held, std::size_t entry) {
    if constexpr (is_list) {
      if (held.size() <= entry) held.resize(entry + 1);
      return held[entry];
    } else if constexpr (Unwrapped<Held>::optional) {
      if (!held) held.emplace();
      return *held;
    } else {
      return held;
    }
  }

  static const auto& viewed(const Held& held, std::size_t entry) {
    if constexpr (is_list) {
      return held.at(entry);
    } else if constexpr (Unwrapped<Held>::optional) {
      return held.value();
    } else {
      return held;
    }
  }

  static std::size_t count(const Held& held) {
    if constexpr (is_list) {
      return held.size();
    } else if constexpr (Unwrapped<Held>::optional) {
      return held ? 1 : 0;
    } else {
      return 1;
    }
  }

  Table table_;
  Held Protocol::*held_;
};

template <class Held, class Part>
TableBuilder(std::string, std::string, Held Part::*) -> TableBuilder<Held>;

}  // namespace cardiac::protocol
