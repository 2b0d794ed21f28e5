#pragma once

#include <string>
#include <vector>

#include <cardiac/run/beat.hpp>

namespace cardiac {

/// End diastole and end systole of one ventricle, and what lies between them.
///
/// With a circulation: ED is the closing of the inlet valve or the onset of contraction, whichever comes
/// later before the largest pressure (a leaking outlet may close the inlet long before); ES is the closing of
/// the outlet valve; both where the pressure drop turns, found between the time steps. A ventricle whose
/// valve never closes has its largest or smallest volume in their place; an inlet that is closed from the
/// beginning of the beat leaves ED to the onset of contraction. Under a prescribed pressure with
/// contraction: its last onset that leaves time for a whole contraction, and the smallest volume of the
/// period that follows (where there is no cavity, the end of contraction); without contraction the first and
/// the last state.
struct KeyStates {
  HeartState ed, es;
  std::string ed_is, es_is;                  ///< which of these they are, in words
  double largest_mm3 = 0, smallest_mm3 = 0;  ///< volumes of the beat: EDV and ESV
  /// Of every step; empty without circulation. Systole from ED to ES: isovolumetric contraction until the
  /// outlet opens, then ejection. Diastole: isovolumetric relaxation until the inlet opens, then filling. An
  /// outlet that never closes leaves ejection and filling alone.
  std::vector<Phase> phases;
  /// By how much a leak changes the volume while both valves are closed, mm³.
  double contraction_change_mm3 = 0, relaxation_change_mm3 = 0;
};

/// Of the left (0) or right (1) ventricle. The path must have steps.
KeyStates key_states(const HeartPath& path, const Scene& scene, int cavity = 0);

/// What is unusual about valves that never close or open, in words.
std::vector<std::string> valve_warnings(const HeartPath& path, const Scene& scene, int cavity = 0);

}  // namespace cardiac
