#include <cardiac/report/normal_values.hpp>

#include <cmath>
#include <limits>

#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::vector<NormalValue> make_values() {
  const std::string vo =
      "magnetic resonance feature tracking, 659 people, mean (95 % interval), Vo et al. 2018, JACC "
      "Cardiovasc. Imaging 11:196–205";
  const std::string resonance = "magnetic resonance", tracking = "magnetic resonance feature tracking, mean";
  const std::string echo = "three-dimensional echocardiography, 2346 people, mean";
  const std::string hunt = "echocardiography, 1266 people (HUNT), mean", clinical = "usual clinical range";
  return {{"End-diastolic volume", "mL", 90, 150, {{"90 to 150", resonance}}},
          {"End-systolic volume",
           "mL",
           kNone,
           kNone,
           {{"about 50", "a healthy model heart, eLife preprint 106555"}}},
          {"Ejection fraction", "%", 50, 70, {{"50 to 70", resonance}}},
          {"Peak pressure", "mmHg", 110, 130, {{"110 to 130", clinical}}},
          {"Ejection fraction", "%", 45, 65, {{"45 to 65", resonance}}},
          {"Peak pressure", "mmHg", 20, 32, {{"20 to 32", clinical}}},
          {"Longitudinal strain (GLS)",
           "%",
           -20.9,
           -16.3,
           {{"−20.1 (−20.9 to −19.3)", vo},
            {"−18.4 (−19.2 to −17.6)", tracking + " (95 % interval)"},
            {"−19.1 (−19.9 to −18.2)", echo + " (95 % interval)"},
            {"−16.3", hunt}},
           true},
          {"Circumferential strain (GCS)",
           "%",
           -24.3,
           -21.4,
           {{"−23.0 (−24.3 to −21.7)", vo}, {"−21.4", tracking}, {"−22.4", echo}, {"−22.7", hunt}},
           true},
          {"Radial strain (GRS)",
           "%",
           28.5,
           56.5,
           {{"34.1 (28.5 to 39.7)", vo}, {"43.7", tracking}, {"56.5", hunt}},
           true},
          {"Twist", "°", 8, 20, {{"8 to 20", clinical}}},
          {"Longitudinal strain (GLS)", "%", -23.3, -20.2, {{"−21.8 (−23.3 to −20.2)", vo}}, true}};
}

}  // namespace

std::string NormalValue::range() const {
  if (std::isnan(low)) return published.front().text;
  const int decimals = strain ? 1 : 0;
  return display_text(low, decimals) + " to " + display_text(high, decimals);
}

std::string NormalValue::place_of(double value) const {
  if (!std::isfinite(value) || std::isnan(low)) return "";
  if (low <= value && value <= high) return "within";
  const bool below = value < low;
  if (!strain) return below ? "lower" : "higher";
  // Of shortening, negative numbers, the lower one is the stronger.
  return below == (high < 0) ? "stronger" : "weaker";
}

const NormalValue& normal_value(Measured quantity) {
  static const std::vector<NormalValue> values = make_values();
  return values.at(static_cast<size_t>(quantity));
}

}  // namespace cardiac
