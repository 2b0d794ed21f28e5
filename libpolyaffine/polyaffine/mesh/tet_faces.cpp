#include "polyaffine/mesh/tet_faces.hpp"

#include <algorithm>
#include <tuple>

namespace polyaffine {

FaceKey face_key(int a, int b, int c) {
  FaceKey key{a, b, c};
  std::sort(key.begin(), key.end());
  return key;
}

std::vector<TetFace> sorted_faces(const Tets& tets) {
  std::vector<TetFace> faces;
  faces.reserve(4 * tets.cols());
  for (int t = 0; t < static_cast<int>(tets.cols()); ++t)
    for (int k = 0; k < 4; ++k)
      faces.push_back(
          {face_key(tets(kTetFaces[k][0], t), tets(kTetFaces[k][1], t), tets(kTetFaces[k][2], t)), t, k});
  std::sort(faces.begin(), faces.end(), [](const TetFace& a, const TetFace& b) {
    return std::tie(a.key, a.tet, a.local) < std::tie(b.key, b.tet, b.local);
  });
  return faces;
}

}  // namespace polyaffine
