#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <cardiac/model/ventricle.hpp>
#include <polyaffine/check/inf_sup.hpp>

namespace cardiac {

/// Whether a reduced model can keep the volume of its wall without locking, and determines its pressures.
struct VolumeCheck {
  std::optional<polyaffine::InfSup> inf_sup;  ///< absent where every integration point is on its own
  int displacements = 0;
  /// Linear compliance of the cavities, (∂V/∂c)ᵀ K⁻¹ ∂V/∂c at rest, at ν = 0.4999 over that at ν = 0.3,
  /// Young's modulus the same. That of a sphere with radii a < b is 0.75 b³ / (0.4 a³ + 0.65 b³), 0.71 for a
  /// thin wall and up to 1.15; functions that keep the volume constraints only by moving less make it
  /// smaller.
  double compliance_ratio = 0;
  std::vector<std::string> warnings;  ///< what is wrong, in words; empty where nothing is
};

/// Bounds of the warnings. Both presets have ratios of 0.88 to 0.97 and inf-sup constants of 0.54 to 0.92 on
/// one ventricle (accurate on two: 0.29); affine frames 0.06 to 0.25, and pressures without their functions
/// 0.06 to 0.17.
inline constexpr double kLockedRatio = 0.7, kUnstableInfSup = 0.3;

/// The model that the scene's reduction makes of an anatomy, its wall neo-Hookean (of the scene's law
/// only Saint Venant–Kirchhoff stays, which has no pressure space). Throws InputError for full order and as
/// reduced_discretisation.
VolumeCheck check_volume(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene);

}  // namespace cardiac
