#include <algorithm>
#include <cctype>
#include <numeric>

#include <cardiac/protocol/key.hpp>
#include <cardiac/protocol/nearest_key.hpp>

namespace cardiac::protocol {
namespace {

char lower(char letter) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

// No key is as long: what lies behind makes it no nearer.
constexpr std::size_t kLongestKey = 100;

/// Distance of two key names; a missing or different unit counts little.
double name_distance(const std::string& given, const std::string& known) {
  const double distance = edit_distance(given, known);
  return known.starts_with(given + '_') ? std::min(distance, 0.5) : distance;
}

}  // namespace

int edit_distance(const std::string& given, const std::string& other) {
  const std::string one = given.substr(0, kLongestKey);
  std::vector<int> row(other.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < one.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i) + 1;
    for (std::size_t j = 0; j < other.size(); ++j) {
      const int replaced = diagonal + (lower(one[i]) != lower(other[j]) ? 1 : 0);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string nearest_key(const std::string& table, const std::string& key) {
  std::string nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const std::string& path, double distance) {
    if (distance < least) {
      least = distance;
      nearest = path;
    }
  };
  for (const Table& known : tables()) {
    const double table_distance = std::min(1.5, 0.5 * edit_distance(table, known.name));
    if (table.empty()) consider(known.name, name_distance(key, known.name));
    for (const Key& row : known.keys) {
      consider(known.name + '.' + row.name, table_distance + name_distance(key, row.name));
    }
  }
  return nearest;
}

std::string nearest_table(const std::string& name) {
  return std::ranges::min(tables(), {}, [&](const Table& table) { return edit_distance(name, table.name); })
      .name;
}

std::string key_path(const std::string& table, std::size_t index, const std::string& key) {
  const Table* known = find_table(table);
  const std::string number = known != nullptr && known->list ? '.' + std::to_string(index + 1) : "";
  if (table.empty() || key.empty()) return table.empty() ? key : table + number;
  return table + number + '.' + key;
}

}  // namespace cardiac::protocol
