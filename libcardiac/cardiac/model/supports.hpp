#pragma once

#include <cardiac/reduction/discretisation.hpp>
#include <polyaffine/system/term.hpp>

namespace cardiac {

/// The factor on the springs and dashpots of the epicardium at a height h along the long axis, 0 at the apex
/// of the cavity and 1 at the base: w = w_apex + (w_base − w_apex) s(h), s = h or, smooth, 3 h² − 2 h³; h is
/// cut off at 0 and 1.
double height_weight(const scene::Boundary& boundary, double height);

/// The factor at points of the epicardium: height_weight times that of the mesh's vertices, interpolated.
polyaffine::Vector epicardial_weights(const Anatomy& anatomy, const scene::Boundary& boundary,
                                      const polyaffine::SurfacePoints& points);

/// What holds the surfaces of a wall: springs and dashpots on its epicardium and on an elastic base, along
/// the base's own reference normals and across them apart (Robin boundaries, Pfaller et al. 2019). Of a
/// sliding base, whose points move in its plane, the ring of the left cavity is held as a whole in this
/// plane: its mean displacement and its mean rotation about the base normal by springs of
/// kRingStiffness_mN_per_mm. As the loads of closed cavities have neither a sum nor a moment, these springs
/// carry nothing unless the epicardium does: they but choose one of all equal positions.
polyaffine::Terms supports(const Anatomy& anatomy, const Scene& scene, const Discretisation& discretisation);

inline constexpr double kRingStiffness_mN_per_mm = 1000;

/// Throws InputError, naming the key, when a heart whose base moves is held against some rigid motion by
/// nothing: of each surface with a stiffness the motions that its springs resist are counted.
void check_held(const Anatomy& anatomy, const Scene& scene, const Discretisation& discretisation);

}  // namespace cardiac
