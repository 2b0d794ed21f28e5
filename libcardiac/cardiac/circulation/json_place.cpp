#include "cardiac/circulation/json_place.hpp"

#include <algorithm>

namespace cardiac {

nlohmann::json parsed(const std::string& text, const std::string& source) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::out_of_range& error) {
    throw polyaffine::InputError(source + ": found a number that is none (" + error.what() +
                                 "), expected a model");
  } catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    throw polyaffine::InputError(source + ":" + std::to_string(1 + std::count(text.begin(), end, '\n')) +
                                 ": found no valid JSON (" + error.what() + "), expected a model");
  }
}

}  // namespace cardiac
