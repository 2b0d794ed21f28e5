#pragma once

#include <array>

#include "cardiac/circulation/json_place.hpp"
#include "cardiac/circulation/svzerod.hpp"

/// For the sources of this folder only.
namespace cardiac {

/// A block of "chambers" and the inertance of its outflow (kPa·ms²/mm³).
struct ChamberBlock {
  Chamber chamber;
  double inertance_kPa_ms2_per_mm3;
};
ChamberBlock chamber_of(const JsonPlace& block, const SvZeroDFactors& factors, double period_ms);

/// The values of a key times a factor at the times "t", counted from the first; one value alone is constant.
TimeSeries series_of(const JsonPlace& values, const char* key, double factor, double ms);

/// The block ClosedLoopHeartAndPulmonary: right atrium, right ventricle, left atrium, left ventricle, the
/// valve behind each, the lungs as C and R, and the compliance of the aorta. Ventricles are E(t) (V − V_u)
/// with a measured E, atria contract by a cosine and stiffen at rest. Source: Sankaran et al. 2012; Menon et
/// al. 2023.
struct ClosedLoopHeart {
  std::array<Chamber, 4> chambers;
  std::array<Element, 4> valves;
  double lungs_mm3_per_kPa, lungs_kPa_ms_per_mm3, aorta_mm3_per_kPa;
};
ClosedLoopHeart closed_loop_heart(const JsonPlace& parameters, const SvZeroDFactors& factors,
                                  double period_ms);

}  // namespace cardiac
