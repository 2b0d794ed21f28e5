#pragma once

#include <string>
#include <vector>

#include <polyaffine/core/types.hpp>

namespace cardiac {

/// The pressure in a cavity of Aróstica et al. 2025, from zero at t = 0:
///   ṗ = −|b| p + σ_mid max(b, 0) + σ_pre max(g, 0),  b = a_pre + α_pre g + α_mid,
///   a_pre = α_max f − 30 (1 − f), f = S⁺(t − 0.17) S⁻(t − 0.484), g = S⁻(t − 0.484), t in s,
/// S± = ½ (1 ± tanh(·/0.005)), α_max = α_pre = 5 and −30 in 1/s.
struct BenchmarkPressure {
  double sigma_mid_kPa = 16, sigma_pre_kPa = 7;
  double alpha_mid_per_s = 1;
};

/// ṗ in kPa/ms at a time in ms.
double pressure_rate(const BenchmarkPressure& pressure, double time_ms, double pressure_kPa);

/// p at the times 0, step, 2 step, …, kPa; linear between them it is as exact as 1e-4 of its peak with 0.5
/// ms.
class BenchmarkPressureCurve {
 public:
  BenchmarkPressureCurve(const BenchmarkPressure& pressure, double end_ms);
  double at(double time_ms) const;

 private:
  double step_ms_;
  polyaffine::Vector values_;
};

/// A point whose displacement the groups tell, with the range of their largest displacements along x, mm.
struct BenchmarkPoint {
  std::string name;
  polyaffine::Vec3 position_mm;
  double peak_ux_mm, peak_low_mm, peak_high_mm;
};

/// A problem of Aróstica et al. 2025.
struct ElastodynamicsCase {
  std::string name, title;
  std::string mesh, surface;  ///< files of data/arostica2025
  std::string envelope;       ///< of the groups' curves, a file beside them
  bool two_ventricles = false;
  std::vector<BenchmarkPressure> pressures{};  ///< of the cavities; empty: no pressure
  double base_stiffness_kPa_per_mm = 0.1;
  int element_order = 2;     ///< of full order
  double end_ms = 1000;      ///< of full order and of the model beside it
  double slack_percent = 0;  ///< of the largest displacements, beyond the groups' range
  double curve_excess_mm =
      0.2;  ///< accepted of the curves beyond the range: twice what is reached, in relaxation
  double reduced_percent = 10;  ///< accepted of the untrained reduced model against full order
  std::vector<BenchmarkPoint> points{};
  double rest_volume_mL = 0;  ///< of the left cavity; 0: not told
  double least_volume_low_mL = 0, least_volume_high_mL = 0;
};

/// The left ventricle contracting (step 0A), contracting under pressure (step 1), and both ventricles.
const std::vector<ElastodynamicsCase>& elastodynamics_cases();

}  // namespace cardiac
