#include "vertex_displacement.hpp"

namespace cardiac::app {

polyaffine::DisplacementMap vertex_displacement(const Ventricle& ventricle) {
  const auto& mesh = ventricle.anatomy->mesh;
  // One tet and corner for each vertex of the mesh.
  std::vector<int> tet(mesh.num_points());
  Eigen::Matrix4Xd barycentric = Eigen::Matrix4Xd::Zero(4, mesh.num_points());
  for (int t = 0; t < mesh.num_tets(); ++t)
    for (int k = 0; k < 4; ++k) {
      tet[mesh.tets()(k, t)] = t;
      barycentric.col(mesh.tets()(k, t)) = polyaffine::Vec4::Unit(k);
    }
  return {*ventricle.discretisation.basis, tet, barycentric};
}

}  // namespace cardiac::app
