#pragma once

#include <string>
#include <vector>

#include <polyaffine/core/types.hpp>

namespace cardiac {

/// Outer surface of one model in the half plane (x⁺, 0, z).
struct EllipsoidProfile {
  std::string name, colour;
  polyaffine::Points u;  ///< displacement at the points of the meridian, mm
};

/// Error of one model against its unknowns.
struct EllipsoidPoint {
  int unknowns = 0;
  double error_percent = 0;
};
struct EllipsoidCurve {
  std::string name, colour;
  std::vector<EllipsoidPoint> points;
};

/// Left the profiles with displacements times `factor` over the undeformed meridian X (mm), right the error
/// against the unknowns, both logarithmic.
std::string ellipsoid_svg(const polyaffine::Points& X, const std::vector<EllipsoidProfile>& profiles,
                          double factor, const std::vector<EllipsoidCurve>& curves);

}  // namespace cardiac
