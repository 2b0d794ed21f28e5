#include <toml++/toml.h>
#include <sstream>

#include <cardiac/protocol/entries.hpp>
#include <cardiac/protocol/key.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac::protocol {
namespace {

const std::string kDigits = "0123456789";
const std::string kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";

bool made_of(const std::string& text, const std::string& letters) {
  return text.find_first_not_of(letters) == std::string::npos;
}

Json json_of(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* whole = node.as_integer()) return whole->get();
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* array = node.as_array()) {
    Json list = Json::array();
    for (const auto& entry : *array) list.push_back(json_of(entry));
    return list;
  }
  return {};
}

/// At most some lines of a message, cut between two characters of UTF-8.
std::string shortened(const std::string& text) {
  std::size_t end = 200;
  if (text.size() <= end) return text;
  while ((static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + " ...";
}

std::string found_text(const toml::node& node) {
  std::ostringstream text;
  if (const auto* number = node.as_floating_point()) {
    text << "the number " << number_text(number->get());
  } else if (const auto* whole = node.as_integer()) {
    text << "the number " << whole->get();
  } else if (const auto* flag = node.as_boolean()) {
    text << (flag->get() ? "true" : "false");
  } else if (const auto* word = node.as_string()) {
    text << "the text \"" << word->get() << '"';
  } else if (node.is_array_of_tables()) {
    text << "a list of tables";
  } else if (const auto* array = node.as_array()) {
    text << "the list " << *array;
  } else if (node.is_table()) {
    text << "a table";
  } else {
    text << "a date or time";
  }
  return shortened(text.str());
}

/// Flattens a document; `place` is the name of the source, with the line added unless it is an option.
class Flattening {
 public:
  Flattening(std::string place, bool is_file) : place_(std::move(place)), is_file_(is_file) {}

  std::vector<Entry> document(const toml::table& root) {
    for (const auto& [name, node] : root) {
      const std::string table(name.str());
      const Table* known = find_table(table);
      if (known != nullptr && known->list) {
        add_list(table, node);
      } else if (node.is_array_of_tables() && known == nullptr) {
        add_entries(table, *node.as_array());
      } else if (node.is_table()) {
        add_table(table, 0, *node.as_table(), node);
      } else {
        add({"", 0, table, json_of(node), found_text(node), where(node)});
      }
    }
    return std::move(entries_);
  }

 private:
  void add_entries(const std::string& table, const toml::array& elements) {
    std::size_t index = 0;
    for (const auto& element : elements) add_table(table, index++, *element.as_table(), element);
  }

  /// What is given for a list of tables.
  void add_list(const std::string& table, const toml::node& node) {
    if (node.is_array() && node.as_array()->empty())
      add({table, 0, "", Json::array(), "an empty list", where(node)});
    else if (node.is_array_of_tables())
      add_entries(table, *node.as_array());
    else if (!is_file_ && node.is_table())
      add_numbered(table, *node.as_table());
    else
      add({"", 0, table, json_of(node), found_text(node), where(node)});
  }

  void add_numbered(const std::string& table, const toml::table& elements) {
    for (const auto& [number, node] : elements) {
      const std::string digits(number.str());
      if (digits.empty() || digits.size() > 4 || digits.front() == '0' || !made_of(digits, kDigits) ||
          !node.is_table()) {
        throw polyaffine::InputError(place_ + ": " + table + '.' + digits + ": expected the number of a [[" +
                                     table + "]] entry, from 1, and a key: " + table + ".1.KEY=VALUE");
      }
      add_table(table, std::stoul(digits) - 1, *node.as_table(), node, true);
    }
  }

  void add_table(const std::string& table, std::size_t index, const toml::table& content,
                 const toml::node& node, bool existing = false) {
    if (!existing) add({table, index, "", {}, "a table", where(node)});
    for (const auto& [key, value] : content) {
      const std::string nested = table + '.' + std::string(key.str());
      if (find_table(nested) != nullptr) {
        add_list(nested, value);
        continue;
      }
      add({table, index, std::string(key.str()), json_of(value), found_text(value), where(value)});
    }
  }

  void add(Entry entry) { entries_.push_back(std::move(entry)); }

  std::string where(const toml::node& node) const {
    return is_file_ ? place_ + ':' + std::to_string(node.source().begin.line) : place_;
  }

  std::string place_;
  bool is_file_;
  std::vector<Entry> entries_;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

std::vector<Entry> read_entries(const std::string& text, const std::string& source) {
  try {
    return Flattening(source, true).document(toml::parse(text));
  } catch (const toml::parse_error& error) {
    throw polyaffine::InputError(source + ':' + std::to_string(error.source().begin.line) + ':' +
                                 std::to_string(error.source().begin.column) +
                                 ": not valid TOML: " + std::string(error.description()));
  }
}

std::vector<Entry> read_override(const std::string& assignment) {
  const std::string option = "--set " + shortened(assignment);
  const auto equals = assignment.find('=');
  const std::string path = trimmed(assignment.substr(0, equals));
  const std::string value = equals == std::string::npos ? "" : trimmed(assignment.substr(equals + 1));
  if (path.empty() || !made_of(path, kLetters + kDigits + "_-.") || path.front() == '.' ||
      path.back() == '.' || path.find("..") != std::string::npos || value.empty()) {
    throw polyaffine::InputError(option + ": expected key.path=value, for instance time.heart_rate_bpm=60");
  }
  const bool word = made_of(value, kLetters + kDigits + "_./-") &&
                    !made_of(value.substr(0, 1), kDigits + "-") && value != "true" && value != "false" &&
                    value != "inf" && value != "nan";
  try {
    return Flattening(option, false).document(toml::parse(path + " = " + (word ? '"' + value + '"' : value)));
  } catch (const toml::parse_error& error) {
    throw polyaffine::InputError(option +
                                 ": the value is not valid TOML: " + std::string(error.description()));
  }
}

}  // namespace cardiac::protocol
