#pragma once

#include <array>
#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Vertices of face k (opposite vertex k) of a tet, outward for a positive one.
inline constexpr std::array<std::array<int, 3>, 4> kTetFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

using FaceKey = std::array<int, 3>;  ///< the three vertices in ascending order

FaceKey face_key(int a, int b, int c);

/// A face as one of its tets sees it.
struct TetFace {
  FaceKey key;
  int tet, local;  ///< face `local` of tet `tet`
};

/// All faces of all tets, sorted by key, then tet and face: faces that tets share follow one another.
std::vector<TetFace> sorted_faces(const Tets& tets);

}  // namespace polyaffine
