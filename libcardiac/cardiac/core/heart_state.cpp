#include "cardiac/core/heart_state.hpp"

namespace cardiac {

polyaffine::Vector HeartState::circulation() const {
  polyaffine::Vector out(volumes_mm3.size() + vessels_kPa.size());
  out << volumes_mm3, vessels_kPa;
  return out;
}

}  // namespace cardiac
