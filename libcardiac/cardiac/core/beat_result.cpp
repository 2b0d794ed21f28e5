#include "cardiac/core/beat_result.hpp"

#include <algorithm>
#include <cmath>

namespace cardiac {

double EnergyBalance::residual() const {
  return active_mJ - cavities_mJ - elastic_mJ - supports_mJ - kinetic_mJ - viscosity_mJ - dashpots_mJ;
}

double EnergyBalance::percent() const {
  return 100 * std::abs(residual()) / std::max(std::abs(active_mJ), std::abs(cavities_mJ));
}

}  // namespace cardiac
