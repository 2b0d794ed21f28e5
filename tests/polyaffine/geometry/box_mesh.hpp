#pragma once

#include <array>
#include <functional>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// Six tets (Kuhn) in each of n cells of the box [low, high] whose centre satisfies `keep`; interior vertices
/// moved at random by up to `jitter` of a cell.
inline TetMesh box_mesh(
    const Vec3& low, const Vec3& high, const Eigen::Vector3i& n, double jitter = 0,
    const std::function<bool(const Vec3&)>& keep = [](const Vec3&) { return true; }) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-jitter, jitter);
  const Vec3 cell = (high - low).cwiseQuotient(n.cast<double>());
  std::map<std::array<int, 3>, int> index;
  std::vector<Vec3> points;
  std::vector<Eigen::Vector4i> tets;
  const auto vertex = [&](const std::array<int, 3>& ijk) {
    const auto [it, added] = index.try_emplace(ijk, static_cast<int>(points.size()));
    if (added) {
      Vec3 x = low;
      for (int d = 0; d < 3; ++d) {
        const bool inside = ijk[d] > 0 && ijk[d] < n[d];
        x[d] += cell[d] * (ijk[d] + (inside ? uniform(random) : 0));
      }
      points.push_back(x);
    }
    return it->second;
  };
  constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k) {
        if (!keep(low + cell.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5)))) continue;
        for (size_t o = 0; o < kOrders.size(); ++o) {
          std::array<int, 3> at{i, j, k};
          Eigen::Vector4i tet;
          tet[0] = vertex(at);
          for (int s = 0; s < 3; ++s) {
            ++at[kOrders[o][s]];
            tet[s + 1] = vertex(at);
          }
          if (o >= 3) std::swap(tet[2], tet[3]);
          tets.push_back(tet);
        }
      }
  Points p(3, static_cast<Eigen::Index>(points.size()));
  for (size_t i = 0; i < points.size(); ++i) p.col(i) = points[i];
  Tets t(4, static_cast<Eigen::Index>(tets.size()));
  for (size_t i = 0; i < tets.size(); ++i) t.col(i) = tets[i];
  return TetMesh(p, t);
}

}  // namespace polyaffine
