#pragma once

#include <cardiac/circulation/valve.hpp>
#include <cardiac/circulation/windkessel.hpp>

namespace cardiac {

/// A valve in series with the proximal resistance Z of the arteries behind it, as one valve between cavity
/// and capacitor: R + Z forward, R_leak + Z backward.
inline Valve outlet(Valve valve, const Windkessel& arteries) {
  valve.resistance_kPa_ms_per_mm3 += arteries.proximal_resistance_kPa_ms_per_mm3;
  valve.leak_kPa_ms_per_mm3 += arteries.proximal_resistance_kPa_ms_per_mm3;
  return valve;
}

}  // namespace cardiac
