#pragma once

#include <polyaffine/core/types.hpp>

namespace cardiac {

/// One state of the coupled heart. Cavities are numbered as in the model's list, the left ventricle first.
struct HeartState {
  double time_ms = 0;                                 ///< from the start of the beat
  polyaffine::Vector c;                               ///< coefficients of the wall, mm
  polyaffine::Vector volumes_mm3{}, pressures_kPa{};  ///< of the cavities
  /// Pressures of the circulation's vessels, of a network also its other states (CirculationModel); empty
  /// without a circulation.
  polyaffine::Vector vessels_kPa{};
  /// Active tension of the integration points (second Piola–Kirchhoff stress, kPa) where it is no function of
  /// time alone; else empty.
  polyaffine::Vector tension_kPa{};

  /// The states of a CirculationModel: volumes, then pressures of vessels.
  polyaffine::Vector circulation() const;
};

}  // namespace cardiac
