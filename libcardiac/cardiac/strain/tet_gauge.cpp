#include "cardiac/strain/tet_gauge.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <cardiac/fibres/helix.hpp>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::Matrix;
using polyaffine::Points;
using polyaffine::Vec3;
using polyaffine::Vec4;

TetGauge::TetGauge(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                   const Points& x_ed)
    : tets_(mesh.tets()) {
  for (int t = 0; t < mesh.num_tets(); ++t) {
    from_mesh_.emplace_back(edges(t, mesh.points()).inverse());
    const Mat3 ed = edges(t, x_ed);
    // Dynamic size: g++ 12 warns of fixed-size singular values without cause.
    const Eigen::JacobiSVD<Matrix> svd(ed * from_mesh_.back(), Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Mat3 rotation = svd.matrixU() * svd.matrixV().transpose();
    const Mat3 axes = orthonormal_axes(coordinates.wall_sample(t, Vec4::Constant(0.25)));
    from_axes_.emplace_back(ed.inverse() * rotation * axes);
  }
}

Mat3 TetGauge::edges(int tet, const Points& x) const {
  Mat3 out;
  for (int k = 0; k < 3; ++k) out.col(k) = x.col(tets_(k + 1, tet)) - x.col(tets_(0, tet));
  return out;
}

Points TetGauge::strain(const Points& x) const {
  Points out(3, tets_.cols());
  for (int t = 0; t < static_cast<int>(tets_.cols()); ++t)
    out.col(t) = (edges(t, x) * from_axes_[t]).colwise().norm().transpose().array() - 1;
  return out;
}

Points TetGauge::turned(const Points& directions, const Points& x) const {
  Points out(3, tets_.cols());
  for (int t = 0; t < static_cast<int>(tets_.cols()); ++t)
    out.col(t) = (edges(t, x) * (from_mesh_[t] * directions.col(t))).normalized();
  return out;
}

}  // namespace cardiac
