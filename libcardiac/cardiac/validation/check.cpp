#include "cardiac/validation/check.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

using Json = nlohmann::ordered_json;
using polyaffine::InputError;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

double parse_number(const std::string& text, const std::string& whole) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw InputError("--expect: found \"" + whole + "\", expected CASE/QUANTITY=LOW:HIGH with two numbers");
  return value;
}

}  // namespace

Expectation parse_expectation(const std::string& text) {
  const auto equals = text.find('=');
  const auto colon = text.find(':', equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos || colon == std::string::npos)
    throw InputError("--expect: found \"" + text + "\", expected CASE/QUANTITY=LOW:HIGH");
  return {text.substr(0, equals), parse_number(text.substr(equals + 1, colon - equals - 1), text),
          parse_number(text.substr(colon + 1), text)};
}

void apply_expectation(const Expectation& expectation, std::vector<Check>& checks) {
  bool found = false;
  for (Check& check : checks) {
    if (check.case_name + "/" + check.quantity != expectation.name) continue;
    check.low = expectation.low;
    check.high = expectation.high;
    check.source = "--expect on the command line";
    found = true;
  }
  if (!found)
    throw InputError("--expect: found \"" + expectation.name +
                     "\", expected a CASE/QUANTITY that was computed");
}

std::string validation_text(const std::vector<Check>& checks) {
  Json list = Json::array();
  for (const Check& c : checks) {
    list.push_back({{"case", c.case_name},
                    {"method", c.method},
                    {"quantity", c.quantity},
                    {"unit", c.unit},
                    {"value", number(c.value)},
                    {"reference", number(c.reference)},
                    {"low", number(c.low)},
                    {"high", number(c.high)},
                    {"source", c.source},
                    {"passed", c.passed()},
                    {"wall_time_s", number(c.wall_time_s)}});
    if (c.record)
      list.back()["record"] = {{"steps", c.record->steps},
                               {"newton_iterations", c.record->newton_iterations},
                               {"cuts", c.record->cuts},
                               {"completed", c.record->completed},
                               {"simulated_ms", number(c.record->simulated_ms)},
                               {"outcome", c.record->outcome},
                               {"warnings", c.record->warnings}};
  }
  return Json{{"checks", list}, {"passed", all_passed(checks)}}.dump(2) + "\n";
}

bool all_passed(const std::vector<Check>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const Check& c) { return c.passed(); });
}

}  // namespace cardiac
