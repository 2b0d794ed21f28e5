#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <cardiac/core/beat_result.hpp>
#include <polyaffine/kinematics/lagrange.hpp>

namespace cardiac::testing {

/// How well maps of segments give back the motion of the vertices from y to x: with four Gauss points in each
/// tet, the relative error of the maps and that of the best maps there are (least squares at these points).
struct RebuildErrors {
  double maps = 0, best = 0;
};

inline std::vector<RebuildErrors> rebuild_errors(const polyaffine::TetMesh& mesh,
                                                 const std::vector<int>& segment, const polyaffine::Points& y,
                                                 const polyaffine::Points& x,
                                                 const std::vector<SegmentNode>& nodes,
                                                 const std::vector<SegmentFrame>& maps) {
  using polyaffine::Vec3;
  const std::size_t count = nodes.size();
  const auto points = polyaffine::LagrangeBasis(mesh, 1).wall_points(2);
  std::vector<double> off(count), motion(count), rest(count);
  std::vector<Eigen::Matrix4d> gram(count, Eigen::Matrix4d::Zero());
  std::vector<Eigen::Matrix<double, 3, 4>> moment(count, Eigen::Matrix<double, 3, 4>::Zero());
  for (int pass = 0; pass < 2; ++pass)
    for (Eigen::Index i = 0; i < points.weights.size(); ++i) {
      const auto corners = mesh.tets().col(points.tet[i]);
      const Vec3 from = y(Eigen::all, corners) * points.barycentric.col(i);
      const Vec3 to = x(Eigen::all, corners) * points.barycentric.col(i);
      const std::size_t s = segment[points.tet[i]] - 1;
      const auto& [q, R] = nodes[s];
      const double w = points.weights[i];
      const Eigen::Vector4d p = Vec3(from - q).homogeneous();
      if (pass == 0) {
        gram[s] += w * p * p.transpose();
        moment[s] += w * (to - from) * p.transpose();
        motion[s] += w * (to - from).squaredNorm();
        const Vec3 rebuilt = q + R * (maps[s].A * R.transpose() * (from - q) + maps[s].t);
        off[s] += w * (rebuilt - to).squaredNorm();
      } else {
        rest[s] += w * (to - from - moment[s] * gram[s].ldlt().solve(p)).squaredNorm();
      }
    }
  std::vector<RebuildErrors> out;
  for (std::size_t s = 0; s < count; ++s)
    out.push_back({std::sqrt(off[s] / motion[s]), std::sqrt(rest[s] / motion[s])});
  return out;
}

}  // namespace cardiac::testing
