#pragma once

#include <cardiac/anatomy/anatomy.hpp>

namespace cardiac {

/// The way of the vertex next to a place when the vertices move to `points`, mm: where a landmark goes.
polyaffine::Vec3 way_of_nearest(const polyaffine::TetMesh& mesh, const polyaffine::Points& points,
                                const polyaffine::Vec3& place);

/// The heart with its vertices elsewhere (mm): the same tets, surfaces and weights, and landmarks that move
/// with the vertex next to them. Coordinates and segments are those of the new shape, and with them fibres by
/// a rule; those of a file are carried along (FileFibres::moved). Directions of the options (long axis,
/// anterior) stay. Throws InputError as TetMesh where a tet turns inside out, and as make_anatomy.
Anatomy moved_anatomy(const Anatomy& anatomy, const polyaffine::Points& points);

}  // namespace cardiac
