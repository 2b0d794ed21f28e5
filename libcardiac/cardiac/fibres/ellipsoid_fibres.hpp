#pragma once

#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/fibres/helix.hpp>

namespace cardiac {

/// Depth t of a point in the family of ellipsoids r_s(t) = endo_short + t (epi_short − endo_short), r_l(t)
/// alike: 0 on the endocardium, 1 on the epicardium, beyond them outside the wall. Throws InputError where no
/// ellipsoid of the family passes (near the centre).
double ellipsoid_depth(const TruncatedEllipsoid& shape, const Vec3& X);

/// Depth and orthonormal local axes (columns longitudinal, circumferential, radial) of Land et al. 2015
/// (Proc. R. Soc. A 471, 20150641, problem 3): with X = (r_s sin u cos v, r_s sin u sin v, r_l cos u) at
/// constant t, u in (−π, 0), e_l = ∂X/∂u normalised points to the base, e_c = ∂X/∂v normalised runs
/// counter-clockwise seen from the base, e_r = e_c × e_l is the outward normal of the ellipsoid through the
/// point. On the axis, where v has no value, that of a point towards +x is used.
CoordinateSample ellipsoid_sample(const TruncatedEllipsoid& shape, const Vec3& X);

/// Columns f, s, n at points in the wall (3 × n, mm): helix_axes in these axes. Land et al. use +90 to −90
/// degrees.
FibreAxes ellipsoid_fibres(const TruncatedEllipsoid& shape, const HelixAngles& angles, const Points& X);

}  // namespace cardiac
