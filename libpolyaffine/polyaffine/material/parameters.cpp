#include <cmath>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>

#include <polyaffine/core/error.hpp>
#include <polyaffine/material/parameters.hpp>

namespace polyaffine {

void require(bool ok, std::string_view name, double value, std::string_view expected) {
  if (ok) return;
  std::ostringstream message;
  message << name << ": found " << value << ", expected " << expected;
  throw InputError(message.str());
}

void require_positive(std::string_view name, double value, std::string_view unit) {
  require(std::isfinite(value) && value > 0, name, value, "a number > 0 in " + std::string(unit));
}

void require_not_negative(std::string_view name, double value, std::string_view unit) {
  require(std::isfinite(value) && value >= 0, name, value, "a number >= 0 in " + std::string(unit));
}

Lame lame(const Elasticity& elasticity) {
  const auto [young, poisson] = elasticity;
  require_positive("Young's modulus", young, "kPa");
  require(poisson > -1 && poisson < 0.5, "Poisson's ratio", poisson,
          "a dimensionless number between -1 and 0.5, both excluded");
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

StiffnessFactor::StiffnessFactor(std::vector<double> values) : values_(std::move(values)) {
  for (std::size_t i = 0; i < values_.size(); ++i)
    require_not_negative("stiffness factor of point " + std::to_string(i), values_[i], "1 (dimensionless)");
}

void StiffnessFactor::require_size(std::ptrdiff_t points) const {
  const auto size = std::ssize(values_);
  require(size == 0 || size == points, "number of stiffness factors", static_cast<double>(size),
          "none or one for each of " + std::to_string(points) + " points");
}

}  // namespace polyaffine
