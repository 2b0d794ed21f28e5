#include "cardiac/model/vertex_displacement.hpp"

namespace cardiac {

polyaffine::WallPoints vertex_points(const polyaffine::TetMesh& mesh) {
  polyaffine::WallPoints out;
  out.tet.resize(mesh.num_points());
  out.barycentric = Eigen::Matrix4Xd::Zero(4, mesh.num_points());
  for (int t = 0; t < mesh.num_tets(); ++t)
    for (int k = 0; k < 4; ++k) {
      out.tet[mesh.tets()(k, t)] = t;
      out.barycentric.col(mesh.tets()(k, t)) = polyaffine::Vec4::Unit(k);
    }
  return out;
}

polyaffine::DisplacementMap vertex_displacement(const polyaffine::TetMesh& mesh,
                                                const polyaffine::Basis& basis) {
  const polyaffine::WallPoints vertices = vertex_points(mesh);
  return {basis, vertices.tet, vertices.barycentric};
}

polyaffine::DisplacementMap vertex_displacement(const Ventricle& ventricle) {
  return vertex_displacement(ventricle.anatomy->mesh, *ventricle.discretisation.basis);
}

}  // namespace cardiac
