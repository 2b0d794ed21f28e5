#pragma once

#include <cardiac/anatomy/idealised.hpp>
#include <polyaffine/mesh/curved_edges.hpp>

namespace cardiac {

/// Midpoints that put the quadratic edges of a mesh of an idealised ventricle on its exact surface: the
/// straight middle of each boundary edge is moved to the nearest point of the surface it is labelled with
/// (kEndocardium, kEpicardium, kBase), of the rim where it lies on the base and an ellipsoid. Throws
/// InputError for other labels.
polyaffine::EdgeMidpoints exact_midpoints(const TruncatedEllipsoid& shape, const polyaffine::TetMesh& mesh);

}  // namespace cardiac
