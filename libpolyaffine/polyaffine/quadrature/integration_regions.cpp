#include "polyaffine/quadrature/integration_regions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/geodesic_regions.hpp>

namespace polyaffine {
namespace {

// Tets that no seed can reach join the region whose seed is nearest in space.
void adopt_unreached(const TetMesh& mesh, const std::vector<char>& allowed, GeodesicRegions& regions) {
  for (int t = 0; t < mesh.num_tets(); ++t) {
    if (!allowed[t] || regions.label[t] >= 0) continue;
    double least = std::numeric_limits<double>::infinity();
    for (size_t s = 0; s < regions.seeds.size(); ++s) {
      const double distance = (mesh.tet_centroid(regions.seeds[s].tet) - mesh.tet_centroid(t)).norm();
      if (distance >= least) continue;
      least = distance;
      regions.label[t] = static_cast<int>(s);
    }
  }
}

QuadraturePoints centre_points(const TetMesh& mesh, const std::vector<int>& label, int count) {
  std::vector<std::vector<int>> tets(count);
  for (int t = 0; t < mesh.num_tets(); ++t)
    if (label[t] >= 0) tets[label[t]].push_back(t);
  QuadraturePoints points{std::vector<int>(count), Eigen::Matrix4Xd(4, count), Vector(count)};
  for (int r = 0; r < count; ++r) {
    double volume = 0;
    Vec3 moment = Vec3::Zero();
    for (const int t : tets[r]) {
      volume += mesh.tet_volume(t);
      moment += mesh.tet_volume(t) * mesh.tet_centroid(t);
    }
    const MeshPoint at = locate(mesh, moment / volume, tets[r]);
    points.tet[r] = at.tet;
    points.barycentric.col(r) = at.barycentric;
    points.weights[r] = volume;
  }
  return points;
}

}  // namespace

std::vector<int> share_out(int total, const Vector& volumes, const std::vector<int>& most) {
  const int count = static_cast<int>(volumes.size());
  const int room = std::accumulate(most.begin(), most.end(), 0);
  if (total < count || total > room)
    throw InputError("integration regions: found " + std::to_string(total) +
                     ", expected at least one in each of " + std::to_string(count) +
                     " control regions and at most one a tet, " + std::to_string(room));
  std::vector<int> share(count);
  const Vector ideal = total / volumes.sum() * volumes;
  for (int i = 0; i < count; ++i) share[i] = std::clamp(static_cast<int>(ideal[i]), 1, most[i]);
  for (int given = std::accumulate(share.begin(), share.end(), 0); given != total;) {
    const int step = given < total ? 1 : -1;
    int best = -1;
    for (int i = 0; i < count; ++i) {
      if (step > 0 ? share[i] == most[i] : share[i] == 1) continue;
      if (best < 0 || step * (ideal[i] - share[i]) > step * (ideal[best] - share[best])) best = i;
    }
    share[best] += step;
    given += step;
  }
  return share;
}

IntegrationRegions integration_regions(const EikonalSolver& solver, const std::vector<int>& control,
                                       int count, int total, std::mt19937_64& random, int lloyd_iterations) {
  const TetMesh& mesh = solver.mesh();
  const Vector volumes = region_volumes(mesh, control, count);
  std::vector<int> tets(count, 0);
  for (const int r : control)
    if (r >= 0 && r < count) ++tets[r];
  for (int r = 0; r < count; ++r)
    if (tets[r] == 0)
      throw InputError("control region " + std::to_string(r) + ": found no tet, expected at least one");

  const std::vector<int> share = share_out(total, volumes, tets);
  IntegrationRegions result;
  result.label.assign(mesh.num_tets(), -1);
  for (int r = 0; r < count; ++r) {
    std::vector<char> allowed(mesh.num_tets());
    for (int t = 0; t < mesh.num_tets(); ++t) allowed[t] = control[t] == r;
    GeodesicRegions regions =
        lloyd_regions(solver, random_seeds(mesh, share[r], random, allowed), lloyd_iterations, allowed);
    adopt_unreached(mesh, allowed, regions);
    const int first = static_cast<int>(result.control.size());
    for (int t = 0; t < mesh.num_tets(); ++t)
      if (allowed[t]) result.label[t] = first + regions.label[t];
    result.control.insert(result.control.end(), share[r], r);
  }
  result.points = centre_points(mesh, result.label, total);
  return result;
}

}  // namespace polyaffine
