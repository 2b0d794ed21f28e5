#pragma once

#include <string>

#include <cardiac/core/beat_result.hpp>

/// What is told of a heart that was imaged under pressure: its stress-free shape and its passive filling.
namespace cardiac {

/// The volume at which a human left ventricle of one measured volume and pressure is at another pressure, mL:
/// V = V₀ + (V_m − V₀)(P/P_m)^(1/2.76), V₀ = V_m (0.6 − 0.006 P_m), pressures in mmHg. Source: Klotz et al.
/// 2006.
double klotz_volume_mL(double measured_mL, double measured_mmHg, double pressure_mmHg);

/// `ventricle,pressure_mmHg,volume_mL,klotz_volume_mL`: filling from the stress-free shape, the last column
/// by Klotz et al. from volume and pressure of the image; empty for the right ventricle, and without
/// pressure.
std::string filling_table(const UnloadingResult& unloading);

/// Pressure against volume of the filling beside Klotz's curve, with the image marked.
std::string filling_svg(const UnloadingResult& unloading);

/// In one sentence: pressures, volumes without stress, inflations and the distance left.
std::string unloading_text(const UnloadingResult& unloading);

}  // namespace cardiac
