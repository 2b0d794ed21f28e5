#include "cardiac/validation/extreme.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include <cardiac/validation/extreme_checks.hpp>

namespace cardiac {

std::vector<Check> validate_extreme(const ValidationContext& context) {
  // The longest first; the random protocols share the processors among themselves.
  constexpr std::array groups{extreme_loads,  extreme_models, extreme_materials,
                              extreme_meshes, extreme_beats,  extreme_tolerances};
  std::vector<ExtremeChecks> checks(groups.size() + 1, ExtremeChecks(context));
  side_by_side(groups.size(), [&](std::size_t k) { groups[k](checks[k]); });
  extreme_random(checks.back());
  std::vector<Check> out;
  for (const ExtremeChecks& one : checks) std::ranges::copy(one.checks(), std::back_inserter(out));
  return out;
}

}  // namespace cardiac
