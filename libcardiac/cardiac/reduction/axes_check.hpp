#pragma once

#include <string>
#include <vector>

#include <cardiac/reduction/discretisation.hpp>

namespace cardiac {

/// Angle between the radial axis of a wall and the shortest way through it, ∇t: root mean square over the
/// volume of the left wall and the septum, degrees. Axes are smooth, the wall's normal need not be: where
/// muscle stands into the cavity the two part, or the axes turn within a few millimetres, and displacements
/// along them strain the wall for no reason.
double radial_misfit_deg(const Anatomy& anatomy);

/// Heart axes serve up to here. Measured, ° (displacement against full order in heart and in Cartesian axes):
/// idealised left ventricles 0.6 to 1.0, two ventricles 3.9; an imaged one 6.1 (32 and 11 %), one with two
/// papillary muscles 13 (270 and 9 %).
inline constexpr double kTurningAxes_deg = 5;

/// The axes that a scene's reduced model with tents has on a wall: those it asks for; `automatic` heart
/// axes, or Cartesian ones where they turn too fast or there are two ventricles. What there is to tell about
/// that is added to the warnings.
scene::Axes axes_of(const Anatomy& anatomy, const Scene& scene, std::vector<std::string>& warnings);

/// What to say of an untrained preset on a heart other than a smooth left ventricle: by how much it was off
/// full order on hearts of its kind (docs/accuracy.md). A left ventricle is smooth as the drawn ones are by
/// its radial_misfit_deg; of two ventricles that says little.
std::string untrained_warning(const Anatomy& anatomy, const Scene& scene);

/// What a reduced model gets wrong where the base moves, measured (docs/accuracy.md, "A base that moves");
/// empty where it is clamped.
std::string moving_base_warning(const Scene& scene);

}  // namespace cardiac
