#include "cardiac/validation/extreme.hpp"

#include <array>
#include <utility>

#include <cardiac/validation/extreme_checks.hpp>

namespace cardiac {

std::vector<Check> validate_extreme(const ValidationContext& context) {
  constexpr std::array<std::pair<const char*, void (*)(ExtremeChecks&)>, 7> groups{
      {{"materials", extreme_materials},
       {"loads", extreme_loads},
       {"beats", extreme_beats},
       {"meshes", extreme_meshes},
       {"models", extreme_models},
       {"tolerances", extreme_tolerances},
       {"random", extreme_random}}};
  ExtremeChecks checks(context);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    context.progress(groups[k].first, static_cast<double>(k) / groups.size());
    groups[k].second(checks);
  }
  return checks.checks();
}

}  // namespace cardiac
