#include "cardiac/anatomy/wall_size.hpp"

#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include <cardiac/core/units.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

constexpr std::array<std::pair<const char*, double>, 4> kUnits{
    {{"um", 1e-3}, {"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}}};

bool possible(double mL) {
  return mL >= kLeastWall_mL && mL <= kMostWall_mL;
}

}  // namespace

std::string check_wall_size(double volume_mm3, double mm_per_unit, const WallSizeRule& rule) {
  const double mL = volume_mm3 / mm3_per_mL;
  if (possible(mL)) return "";
  std::ostringstream text;
  text.precision(4);
  text << rule.unit_key << ": the wall has " << mL << " mL in ";
  for (const auto& [unit, mm] : kUnits)
    if (std::abs(mm / mm_per_unit - 1) < 1e-9) text << unit;
  text << std::setprecision(6) << ", expected " << kLeastWall_mL << " to " << kMostWall_mL
       << " mL, what hearts from a mouse's to a horse's have;";
  text.precision(4);
  const char* between = " it would be ";
  for (const auto& [unit, mm] : kUnits) {
    const double other = mL * std::pow(mm / mm_per_unit, 3);
    if (!possible(other)) continue;
    text << between << other << " mL in " << unit;
    between = " or ";
  }
  if (between[1] == 'i') text << " no unit would do";
  if (rule.insist) return text.str();
  throw polyaffine::InputError(text.str() + " (--force insists)");
}

}  // namespace cardiac
