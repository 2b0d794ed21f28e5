#include "cardiac/scene/presets.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <cardiac/scene/contraction_time.hpp>

namespace cardiac {

using namespace scene;

bool is_tuned(const Scene& scene) {
  return scene.reduction.method == Method::polyaffine && scene.reduction.preset == Preset::tuned;
}

bool aha_tents(const Reduction& reduction) {
  return reduction.ring_nodes == Reduction().ring_nodes && !reduction.ring_angles_deg &&
         reduction.weights == Weights::tents;
}

bool region_differs(const Scene& scene, const RegionOverride& region) {
  return region.stiffness_factor != 1 ||
         (scene.contraction && (region.tension_factor != 1 || region.activation_delay_ms != 0));
}

bool regions_differ(const Scene& scene) {
  return std::ranges::any_of(scene.regions,
                             [&](const RegionOverride& r) { return region_differs(scene, r); });
}

namespace {

using Words = std::vector<std::string>;

bool cartesian(const Reduction& reduction, bool heart_wants_it) {
  return reduction.weights == Weights::tents &&
         (reduction.axes == Axes::cartesian || (reduction.axes == Axes::automatic && heart_wants_it));
}

// In Cartesian components an affine map of space is one of the place X, which in the coordinates of a curved
// wall is of second order: cc, ct and lc complete it. With ctt, llt and cct (to third order) the error of two
// ventricles falls on. Where regions differ the wall bends along l and c.
Words enrichment(bool fast, bool is_cartesian, bool contrast) {
  Words words = fast ? Words{"tt", "lt"} : Words{"tt", "lt", "ct", "ltt", "ttt", "ll"};
  if (fast && (is_cartesian || contrast)) words.emplace_back("ct");
  if (is_cartesian || contrast) words.insert(words.end(), {"lc", "cc"});
  if (fast && contrast) words.emplace_back("ll");
  if (!fast && is_cartesian) words.insert(words.end(), {"ctt", "llt", "cct"});
  return words;
}

}  // namespace

void fill_presets(Scene& scene, bool heart_wants_cartesian_axes) {
  Reduction& reduction = scene.reduction;
  const bool fast = reduction.preset == Preset::fast, contrast = regions_differ(scene),
             is_cartesian = cartesian(reduction, heart_wants_cartesian_axes);
  if (reduction.preset == Preset::tuned) {
    // Functions and pressures are those of the heart itself.
    reduction.enrichment.emplace();
    reduction.pressure_space = PressureSpace::segment;
    reduction.border_functions = false;
  }
  if (!reduction.enrichment) reduction.enrichment = enrichment(fast, is_cartesian, contrast);
  if (!reduction.pressure_space) {
    // Tents reproduce a linear pressure. With {1, t} segments of the fast preset lose 1.5 % of their volume
    // at end systole where full order loses 0.4, and {.., lt, ct} hold back the wall in filling.
    const bool tents = reduction.weights == Weights::tents;
    const auto of_sigmoids = fast ? PressureSpace::segment_depth : PressureSpace::segment_bilinear;
    reduction.pressure_space = tents ? PressureSpace::segment_linear : of_sigmoids;
  }
  if (!reduction.border_functions) reduction.border_functions = contrast && aha_tents(reduction);
  if (auto& contraction = scene.contraction)
    contraction->activation_duration_ms = activation_duration_ms(*contraction, scene.time);
}

// Tension stiffens muscle, several times over the passive wall, and at the border of a region that contracts
// otherwise local volumes are drawn apart. With two ventricles the fast preset has too few functions for it:
// 7.3 % of displacement off in filling with 6 kPa, 8.6 % with 20.
void raise_local_bulk_modulus(bool two_ventricles, Scene& scene) {
  if (!scene.contraction) return;
  constexpr double kContracting_kPa = 20, kContrast_kPa = 60, kShare = 0.1;
  double& local = scene.reduction.local_bulk_modulus_kPa;
  double wanted = two_ventricles && scene.reduction.preset == Preset::fast ? local : kContracting_kPa;
  if (regions_differ(scene)) wanted = kContrast_kPa;
  local = std::max(local, std::min(wanted, kShare * scene.tissue.bulk_modulus_kPa));
}

}  // namespace cardiac
