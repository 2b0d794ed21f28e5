#pragma once

/// Factors between what files and screens show (mmHg, mL, s) and what the libraries compute in (kPa, mm³,
/// ms): multiply to go in, divide to go out.
namespace cardiac {

inline constexpr double kPa_per_mmHg = 0.133322387415;  ///< 13.5951 g/cm³ × 9.80665 m/s² × 1 mm
inline constexpr double mm3_per_mL = 1000;
inline constexpr double ms_per_s = 1000;
inline constexpr double ms_per_min = 60 * ms_per_s;

/// mmHg·s/mL to kPa·ms/mm³
inline constexpr double resistance_per_mmHg_s_per_mL = kPa_per_mmHg * ms_per_s / mm3_per_mL;
/// mL/mmHg to mm³/kPa
inline constexpr double compliance_per_mL_per_mmHg = mm3_per_mL / kPa_per_mmHg;
/// mmHg·s²/mL to kPa·ms²/mm³
inline constexpr double inertance_per_mmHg_s2_per_mL = kPa_per_mmHg * ms_per_s * ms_per_s / mm3_per_mL;
/// mmHg·s²/mL² to kPa·ms²/mm⁶
inline constexpr double stenosis_per_mmHg_s2_per_mL2 =
    kPa_per_mmHg * ms_per_s * ms_per_s / mm3_per_mL / mm3_per_mL;
/// mL/s to mm³/ms
inline constexpr double flow_per_mL_per_s = mm3_per_mL / ms_per_s;
/// mmHg/mL to kPa/mm³
inline constexpr double elastance_per_mmHg_per_mL = kPa_per_mmHg / mm3_per_mL;

}  // namespace cardiac
