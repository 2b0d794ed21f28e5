#include "polyaffine/mesh/tet_gradients.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace polyaffine {
namespace {

Mat3 edges(const Points& X, const Eigen::Vector4i& tet) {
  Mat3 out;
  for (int k = 0; k < 3; ++k) out.col(k) = X.col(tet[k + 1]) - X.col(tet[0]);
  return out;
}

}  // namespace

std::vector<Mat3> tet_gradients(const TetMesh& mesh, const Points& points) {
  std::vector<Mat3> out;
  out.reserve(static_cast<std::size_t>(mesh.num_tets()));
  for (const auto& tet : mesh.tets().colwise())
    out.emplace_back(edges(points, tet) * edges(mesh.points(), tet).inverse());
  return out;
}

std::vector<Mat3> vertex_gradients(const TetMesh& mesh, const Points& points) {
  const std::vector<Mat3> of_tet = tet_gradients(mesh, points);
  std::vector<Mat3> out(static_cast<std::size_t>(mesh.num_points()), Mat3::Zero());
  std::vector<double> volume(out.size(), 0);
  for (int t = 0; t < mesh.num_tets(); ++t)
    for (const int p : mesh.tets().col(t)) {
      out[static_cast<std::size_t>(p)] += mesh.tet_volume(t) * of_tet[static_cast<std::size_t>(t)];
      volume[static_cast<std::size_t>(p)] += mesh.tet_volume(t);
    }
  for (std::size_t p = 0; p < out.size(); ++p) out[p] /= volume[p];
  return out;
}

double least_volume_ratio(const TetMesh& mesh, const Points& points) {
  double out = std::numeric_limits<double>::infinity();
  for (int t = 0; t < mesh.num_tets(); ++t)
    out = std::min(out, signed_volume(points, mesh.tets().col(t)) / mesh.tet_volume(t));
  return out;
}

}  // namespace polyaffine
