#pragma once

#include <string>

namespace cardiac {

/// Bounds of the muscle of one or two ventricles, mL. Mouse: a left ventricle of 15 mg at birth and 80 to
/// 110 mg when grown (Wiesmann et al. 2000, Am J Physiol 278:H652); horse: a heart of 0.9 % of 450 to 1000 kg
/// (Gunn 1989, Equine Vet J 21:187); density of muscle 1.05 g/mL.
inline constexpr double kLeastWall_mL = 0.015, kMostWall_mL = 10000;

/// Whether a wall may be a heart's, and what to do when it may not.
struct WallSizeRule {
  std::string unit_key = "mesh.length_unit";  ///< key or option that tells the length unit, for messages
  bool insist = false;                        ///< a wall out of bounds is told, not refused
};

/// Holds a volume of muscle, in mm³ by a length unit of mm_per_unit, to the bounds. Returns what is to be
/// told: empty when it is within them. Throws InputError, naming the key of the unit, the volume and the
/// units in which it would be a heart's, unless the rule insists.
std::string check_wall_size(double volume_mm3, double mm_per_unit, const WallSizeRule& rule);

}  // namespace cardiac
