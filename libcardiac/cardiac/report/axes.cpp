#include <cardiac/report/axes.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

double round_step(double length, int intervals) {
  const double raw = length / intervals, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power * (1 + 1e-9)) return factor * power;
  return 10 * power;
}

constexpr std::array<double, 3> kRoundFactors{1, 2, 5};

// 1, 2 or 5 times a power of ten, at most or at least `value`, which is positive.
double round_below(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  double best = power;
  for (const double factor : kRoundFactors)
    if (factor * power <= value * (1 + 1e-9)) best = factor * power;
  return best;
}

double round_above(double value) {
  return 1 / round_below(1 / value);
}

std::vector<double> log_ticks(double low, double high) {
  std::vector<double> values;
  const bool dense = high <= 100 * low * (1 + 1e-9);
  for (double power = std::pow(10.0, std::floor(std::log10(low))); power <= high * (1 + 1e-9); power *= 10)
    for (const double factor : kRoundFactors)
      if (const double tick = factor * power;
          (dense || factor == 1) && tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9))
        values.push_back(tick);
  return values;
}

}  // namespace

double Axis::fraction(double value) const {
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

std::vector<double> Axis::ticks() const {
  if (logarithmic) return log_ticks(low, high);
  std::vector<double> values;
  const double first = std::ceil(low / step - 1e-6), last = std::floor(high / step + 1e-6);
  for (double i = first; i <= last; ++i) values.push_back(i * step);
  return values;
}

std::string Axis::label(double tick) const {
  if (logarithmic)
    return display_text(tick, std::max(0, -static_cast<int>(std::floor(std::log10(tick) + 1e-9))));
  return display_text(tick, std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9))));
}

Axis tight_axis(double low, double high, int intervals) {
  if (!std::isfinite(low) || !std::isfinite(high) || low > high) low = 0, high = 1;
  const double smallest = std::max(1e-6, 1e-6 * std::max(std::abs(low), std::abs(high)));
  if (high - low < smallest) high = low + std::max(1.0, smallest);
  return {low, high, round_step(high - low, intervals), false};
}

Axis round_axis(double low, double high, int intervals) {
  Axis axis = tight_axis(low, high, intervals);
  axis.low = std::floor(axis.low / axis.step + 1e-9) * axis.step;
  axis.high = std::ceil(axis.high / axis.step - 1e-9) * axis.step;
  return axis;
}

Axis log_axis(double low, double high) {
  constexpr double kMargin = 1.15;
  if (!(low > 0) || !std::isfinite(high) || !(high >= low)) low = 0.1, high = 10;
  return {round_below(low / kMargin), round_above(high * kMargin), 1, true};
}

DrawPoint Plot::at(double x_value, double y_value) const {
  return {left + width * x.fraction(x_value), top + height * (1 - y.fraction(y_value))};
}

void Plot::draw(Svg& svg, std::string_view x_title, std::string_view y_title, double font_size,
                bool y_labels) const {
  const std::string_view grid = "stroke=\"#e3e3e3\" stroke-width=\"1\"";
  const std::string_view axis = "stroke=\"#444444\" stroke-width=\"1.2\"";
  const double bottom = top + height, right = left + width;
  for (const double tick : x.ticks()) {
    const double px = at(tick, y.low).x;
    svg.line({px, top}, {px, bottom}, grid);
    svg.line({px, bottom}, {px, bottom + 5}, axis);
    svg.text({px, bottom + 8 + font_size / 2}, x.label(tick), {font_size, "#444444", Anchor::middle});
  }
  for (const double tick : y.ticks()) {
    const double py = at(x.low, tick).y;
    svg.line({left, py}, {right, py}, tick == 0 ? "stroke=\"#9a9a9a\" stroke-width=\"1\"" : grid);
    svg.line({left - 5, py}, {left, py}, axis);
    if (y_labels) svg.text({left - 9, py}, y.label(tick), {font_size, "#444444", Anchor::end});
  }
  svg.line({left, top}, {left, bottom}, axis);
  svg.line({left, bottom}, {right, bottom}, axis);
  if (!x_title.empty())
    svg.text({left + width / 2, bottom + 14 + 1.6 * font_size}, x_title,
             {font_size, "#222222", Anchor::middle});
  svg.text({left - 14 - 2.8 * font_size, top + height / 2}, y_title,
           {font_size, "#222222", Anchor::middle, false, -90});
}

}  // namespace cardiac
