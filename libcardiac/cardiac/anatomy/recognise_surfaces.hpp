#pragma once

#include <string>
#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac {

/// The surfaces of a heart found from its shape.
struct RecognisedSurfaces {
  std::vector<int> labels;  ///< of each boundary triangle: kEndocardium, kEpicardium, kBase, kRvEndocardium
  std::vector<std::string> notes;  ///< what was recognised, by which sign
};

/// Endocardia, epicardium and base of one or two ventricles that are open at the base.
///
/// - Inside or outside: rays leave each triangle over the hemisphere outside the wall, weighted by the
/// cosine;
///   in a cavity most of them meet the wall again, outside they do not. Triangles beyond doubt are seeds of a
///   watershed (Meyer 1994) that grows over flat edges before sharp ones, so that borders come to lie on the
///   rims.
/// - Cavities are the connected parts of the inside; the opening of each lies in the direction of the sum of
///   its area vectors.
/// - Base: the outside that is reached from the rims over triangles that face the opening; a second watershed
///   divides it from the epicardium.
/// - Of two cavities the left ventricle's is the rounder one: larger V / A^1.5.
/// Throws InputError, saying what was found, when there is no cavity, more than two, or no base, and as
/// check_tapered_rims.
RecognisedSurfaces recognise_surfaces(const polyaffine::TetMesh& mesh);

/// Throws InputError (bare_ring_text) when the wall tapers to an edge at the rim of a cavity and has no base
/// there: along most of the rim inside and outside meet at less than 75°, and the outside goes on from there
/// to the epicardium without a second edge. Takes a closed outward surface, points in mm; a shape without
/// cavities passes.
void check_tapered_rims(const polyaffine::Points& points, const polyaffine::Triangles& boundary);

/// Where the boundary with the label kEndocardium falls into two cavities, the less round one becomes
/// kRvEndocardium; a note says so.
void split_cavities(const polyaffine::TetMesh& mesh, std::vector<int>& labels,
                    std::vector<std::string>& notes);

}  // namespace cardiac
