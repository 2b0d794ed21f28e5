#include "cardiac/anatomy/exact_midpoints.hpp"

#include <algorithm>
#include <set>

namespace cardiac {

polyaffine::EdgeMidpoints exact_midpoints(const TruncatedEllipsoid& shape, const polyaffine::TetMesh& mesh) {
  std::map<std::pair<int, int>, std::set<int>> labels;
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f)
    for (int k = 0; k < 3; ++k)
      labels[std::minmax(mesh.boundary()(k, f), mesh.boundary()((k + 1) % 3, f))].insert(
          mesh.boundary_labels()[f]);
  polyaffine::EdgeMidpoints out;
  for (const auto& [edge, on] : labels) {
    const Vec3 middle = 0.5 * (mesh.points().col(edge.first) + mesh.points().col(edge.second));
    out[edge] = on.size() == 2 && on.contains(kBase) ? project_to_rim(shape, *on.begin(), middle)
                                                     : project_to_surface(shape, *on.begin(), middle);
  }
  return out;
}

}  // namespace cardiac
