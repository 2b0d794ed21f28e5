#include "cardiac/contraction/calcium.hpp"

#include <cmath>

namespace cardiac {

double CalciumTransient::at(double since_ms) const {
  const double t = since_ms - period_ms * std::floor(since_ms / period_ms);
  if (given) return given->at(given->repeats ? t : since_ms).first;
  const double ratio = rise_ms / decay_ms;
  const double beta = std::pow(ratio, ratio / (1 - ratio)) - std::pow(ratio, 1 / (1 - ratio));
  const auto sum = [&](double tau) { return std::exp(-t / tau) / (1 - std::exp(-period_ms / tau)); };
  return diastolic_uM + (peak_uM - diastolic_uM) / beta * (sum(decay_ms) - sum(rise_ms));
}

}  // namespace cardiac
