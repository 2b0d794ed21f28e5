#pragma once

#include <polyaffine/material/law.hpp>

namespace polyaffine {

/// The force of a unit pressure that follows a surface, as a law over M = [x, x_ξ, x_η] (see surface_table):
/// P = [x_ξ × x_η, 0, 0], so that the force on function a is ∫ N_a n da (mm²), along X_ξ × X_η. On a surface
/// whose rim moves it has no potential (W stays 0) and its tangent is not symmetric; A is the symmetric part,
/// which differs from it by an integral over the rim only (Schweizerhof & Ramm 1984). Where the rim is held,
/// SignedVolume gives the same force with a potential.
class FollowerPressure : public Law {
 public:
  void respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const override;
};

}  // namespace polyaffine
