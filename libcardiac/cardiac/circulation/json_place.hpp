#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <polyaffine/core/error.hpp>

/// For the sources of this folder only (it needs the JSON library).
namespace cardiac {

/// A value of a JSON text and where it stands ("file: vessels[2].C"); reading it checks its type. Errors are
/// polyaffine::InputError. The text outlives it.
class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& json, std::string source, std::string path)
      : json_(&json), source_(std::move(source)), path_(std::move(path)) {}

  const std::string& source() const { return source_; }
  std::string where() const { return path_.empty() ? source_ : source_ + ": " + path_; }
  std::string written() const { return json_->dump().substr(0, 80); }
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw polyaffine::InputError(where() + ": found " + found + ", expected " + expected);
  }

  std::optional<JsonPlace> find(const std::string& key) const {
    if (!json_->is_object()) fail(written(), "an object");
    const auto found = json_->find(key);
    if (found == json_->end() || found->is_null()) return {};
    return JsonPlace(*found, source_, path_.empty() ? key : path_ + "." + key);
  }
  JsonPlace at(const std::string& key) const {
    const auto found = find(key);
    if (!found)
      throw polyaffine::InputError(where() + (path_.empty() ? ": " : ".") + key +
                                   ": missing; expected a value");
    return *found;
  }
  double number() const {
    if (!json_->is_number()) fail(written(), "a number");
    return json_->get<double>();
  }
  double number_or(const std::string& key, double otherwise) const {
    const auto found = find(key);
    return found ? found->number() : otherwise;
  }
  /// A number of at least zero; above zero.
  double magnitude() const {
    if (!(number() >= 0)) fail(written(), "a number of at least 0");
    return number();
  }
  double magnitude_or(const std::string& key, double otherwise) const {
    const auto found = find(key);
    return found ? found->magnitude() : otherwise;
  }
  double positive() const {
    if (!(number() > 0)) fail(written(), "a number above 0");
    return number();
  }
  int whole() const {
    if (!json_->is_number_integer()) fail(written(), "a whole number");
    return json_->get<int>();
  }
  bool flag() const {
    if (!json_->is_boolean()) fail(written(), "true or false");
    return json_->get<bool>();
  }
  std::string text() const {
    if (!json_->is_string()) fail(written(), "a text");
    return json_->get<std::string>();
  }
  /// One number, or a list of at least one.
  std::vector<double> numbers() const {
    if (json_->is_number()) return {number()};
    if (!json_->is_array() || json_->empty()) fail(written(), "a list of numbers");
    std::vector<double> out;
    for (const auto& entry : *json_) {
      if (!entry.is_number()) fail(entry.dump().substr(0, 80), "a list of numbers");
      out.push_back(entry.get<double>());
    }
    return out;
  }
  std::size_t size() const { return json_->size(); }
  /// The entries of a list; none where the key is absent.
  std::vector<JsonPlace> list(const std::string& key) const {
    const auto found = find(key);
    std::vector<JsonPlace> out;
    if (!found) return out;
    if (!found->json_->is_array()) found->fail(found->written(), "a list");
    for (const auto& entry : *found->json_)
      out.emplace_back(entry, source_, found->path_ + "[" + std::to_string(out.size()) + "]");
    return out;
  }
  std::vector<std::pair<std::string, JsonPlace>> entries() const {
    if (!json_->is_object()) fail(written(), "an object");
    std::vector<std::pair<std::string, JsonPlace>> out;
    for (const auto& [name, value] : json_->items())
      out.emplace_back(name, JsonPlace(value, source_, path_ + "." + name));
    return out;
  }

 private:
  const nlohmann::json* json_;
  std::string source_, path_;
};

/// The value that a text is. Throws polyaffine::InputError with the line where it is no JSON.
nlohmann::json parsed(const std::string& text, const std::string& source);

}  // namespace cardiac
