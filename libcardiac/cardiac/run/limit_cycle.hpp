#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>

namespace cardiac {

/// One beat as a map of the circulation's slow states (CirculationModel: volumes of the cavities in mm³, then
/// pressures of the vessels in kPa) from its beginning to its end.
struct CycleBeat {
  polyaffine::Vector start, end;
  double stroke_mm3 = 0;
};

/// What the beats so far tell of the one that would repeat itself.
struct CycleEstimate {
  polyaffine::Vector pressures_kPa;  ///< of the vessels when the limit beat begins
  /// Of the last beat: the largest of its distances from the limit, of pressures (in parts of themselves),
  /// volumes at its beginning and stroke volume (in parts of the stroke volume).
  double distance_percent = 0;
  bool extrapolated = false;  ///< false: the pressures are those that the last beat ended with
};

/// The limit of the beats' map x ↦ F(x) of the vessels' pressures. With the residuals g = F(x) − x of beats
/// among the last, those that began furthest from the last one, the numbers θ minimise |g_n − Σ θ_j (g_n −
/// g_{n−j})| (relative to the pressures), and
///   x* = x_n + g_n − Σ θ_j (F(x_n) − F(x_{n−j}));
/// with one vessel this is Aitken's x_n + g_n/(1 − ratio): the distance left is not the difference of two
/// beats but that divided by 1 − ratio. Source: Anderson 1965; Walker, Ni 2011. Only beats that differ in
/// more than noise enter (singular values below 1 % of the largest are left out); what of g_n they do not
/// explain may belong to a slow vessel and adds ten times itself to the distance. An estimate that is not
/// positive, further than 50 differences away or more than half of a pressure off is not used: then the
/// distance is 50 differences. `beats` must not be empty; `volumes` of their states are volumes.
CycleEstimate estimate_limit_cycle(const std::vector<CycleBeat>& beats, int volumes);

/// Whether the beats come no nearer and what is left changes its direction: none of the last three residuals
/// is below half of the smallest before, and one of them points against its forerunner. Of more than four
/// vessels a beat more for each is waited for: the first extrapolations lead about.
bool is_noise(const std::vector<CycleBeat>& beats, int volumes);

}  // namespace cardiac
