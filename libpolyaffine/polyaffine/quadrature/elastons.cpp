#include "polyaffine/quadrature/elastons.hpp"

#include <Eigen/Cholesky>
#include <stdexcept>
#include <string>

#include <polyaffine/geometry/locate.hpp>

namespace polyaffine {

Moments tet_moments(const TetMesh& mesh, int t, const Vec3& centre) {
  const Vec3 c = mesh.tet_centroid(t);
  Mat3 spread = Mat3::Zero();
  for (const int v : mesh.tets().col(t)) {
    const Vec3 d = mesh.points().col(v) - c;
    spread += d * d.transpose() / 20;
  }
  Vec4 at;
  at << 1, c - centre;
  Moments m = at * at.transpose();
  m.bottomRightCorner<3, 3>() += spread;
  return mesh.tet_volume(t) * m;
}

std::vector<Elaston> elastons(const TetMesh& mesh, const IntegrationRegions& regions, int order) {
  if (order != 0 && order != 1)
    throw std::invalid_argument("elastons: found order " + std::to_string(order) + ", expected 0 or 1");
  const Points centres = positions(mesh, regions.points);
  std::vector<Elaston> result(regions.points.size());
  for (int i = 0; i < regions.points.size(); ++i) result[i] = {centres.col(i), Moments::Zero()};
  for (int t = 0; t < mesh.num_tets(); ++t) {
    if (regions.label[t] < 0) continue;
    Elaston& elaston = result[regions.label[t]];
    if (order == 1)
      elaston.moments += tet_moments(mesh, t, elaston.centre);
    else
      elaston.moments(0, 0) += mesh.tet_volume(t);
  }
  return result;
}

QuadraturePoints elaston_points(const TetMesh& mesh, const IntegrationRegions& regions, int order) {
  const std::vector<Elaston> all = elastons(mesh, regions, order);
  if (order == 0) return regions.points;
  // A regular tetrahedron with unit second moments.
  Eigen::Matrix<double, 3, 4> unit;
  unit << 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1, 1;
  QuadraturePoints out{{}, Eigen::Matrix4Xd(4, 4 * all.size()), Vector(4 * all.size())};
  Eigen::Index q = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int tet = regions.points.tet[i];
    const double volume = all[i].moments(0, 0);
    const Vec3 mean = all[i].moments.block<3, 1>(1, 0) / volume;
    const Mat3 spread = all[i].moments.bottomRightCorner<3, 3>() / volume - mean * mean.transpose();
    const Mat3 root = Eigen::LLT<Mat3>(spread).matrixL();
    for (int k = 0; k < 4; ++k, ++q) {
      out.tet.push_back(tet);
      out.barycentric.col(q) = barycentric(mesh, tet, all[i].centre + mean + root * unit.col(k));
      out.weights[q] = volume / 4;
    }
  }
  return out;
}

}  // namespace polyaffine
