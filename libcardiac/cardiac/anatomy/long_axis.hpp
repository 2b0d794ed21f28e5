#pragma once

#include <optional>
#include <string>
#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac {

struct SurfaceLabels;

/// The long axis of a left ventricle, from the apex of its cavity to the centre of the mitral opening.
struct LongAxis {
  polyaffine::Vec3 direction;    ///< unit, apex to base
  polyaffine::Vec3 base_centre;  ///< middle, by length, of the mitral rim, mm
  polyaffine::Vec3 base_normal;  ///< unit, of the mitral opening, out of the cavity
  double base_angle_deg = 0;     ///< between base_normal and the line from apex to base centre
  int openings = 1;              ///< rims of the endocardium
  bool mitral_known = true;      ///< there is one opening, or a point tells which one is the mitral one
  bool given = false;            ///< the direction was given
  bool normal_taken = false;     ///< the direction is base_normal
};

template <class Archive>
void archive(Archive& a, LongAxis& x) {
  a(x.direction, x.base_centre, x.base_normal, x.base_angle_deg, x.openings, x.mitral_known, x.given,
    x.normal_taken);
}

/// Finds it on the mesh.
///
/// - Openings: the open edges of the endocardium, all of which must run along the base. Of several the mitral
///   one is that nearest to `mitral_point` (mm), else the one of the largest area: a mitral annulus has about
///   twice the area of an aortic one (Lang et al. 2015).
/// - Direction: `given` (apex to base, any length), else from the middle of the bottom of the cavity (the
///   lowest tenth of its height) to the base centre. Where that lies within 3° of the normal of a flat base
///   the normal is taken: the place of a blunt apex is known less well than that, the normal exactly.
/// Throws InputError, naming the place, when the endocardium has no rim or one that leaves the base, or when
/// `given` is more than 60° off the way from apex to base.
LongAxis find_long_axis(const polyaffine::TetMesh& mesh, const SurfaceLabels& labels,
                        const std::optional<polyaffine::Vec3>& given,
                        const std::optional<polyaffine::Vec3>& mitral_point);

/// In words, for a report: where the axis runs, the openings, the angle to the base.
std::vector<std::string> notes_of(const LongAxis& axis);
/// What may be wrong about it: an angle above 10°. Of several openings none lies across the axis, and the
/// angle says nothing.
std::vector<std::string> warnings_of(const LongAxis& axis);

}  // namespace cardiac
