#include "cardiac/fibres/fibre_difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <cardiac/anatomy/right_ventricle.hpp>

namespace cardiac {

using polyaffine::TetMesh;
using polyaffine::Vec4;

namespace {

const Vec4 kCentre = Vec4::Constant(0.25);

int region_of(const RightVentricularCoordinates& right, int tet) {
  if (right.border(tet, kCentre).w > 0.5) return 1;
  return right.septal(tet, kCentre) > 0 ? 2 : 0;
}

struct Weighted {
  double angle = 0, volume = 0;
};

// The angle that a share of the volume stays below.
double quantile(const std::vector<Weighted>& sorted, double share, double volume) {
  double below = 0;
  for (const Weighted& w : sorted)
    if ((below += w.volume) >= share * volume) return w.angle;
  return sorted.back().angle;
}

AngleDistribution describe(std::string region, std::vector<Weighted> tets) {
  std::ranges::sort(tets, {}, &Weighted::angle);
  AngleDistribution out{std::move(region)};
  for (const Weighted& w : tets) {
    out.volume_mm3 += w.volume;
    out.mean_deg += w.volume * w.angle;
  }
  out.mean_deg /= out.volume_mm3;
  out.median_deg = quantile(tets, 0.5, out.volume_mm3);
  out.p95_deg = quantile(tets, 0.95, out.volume_mm3);
  return out;
}

}  // namespace

FibreComparison compare_fibres(const TetMesh& mesh, const VentricularCoordinates& coordinates,
                               const FileFibres& file, const HelixAngles& rule) {
  std::vector<int> tets(mesh.num_tets());
  std::iota(tets.begin(), tets.end(), 0);
  const Eigen::Matrix4Xd at = kCentre.replicate(1, mesh.num_tets());
  const FibreAxes a = file.at(coordinates, tets, at), b = helix_fibres(coordinates, tets, at, rule);
  FibreComparison out{file.description(), a.topRows<3>(), {}};
  for (Eigen::Index t = 0; t < a.cols(); ++t) {
    const double cosine = std::abs(a.col(t).head<3>().dot(b.col(t).head<3>()));
    out.angle_deg.push_back(180 / polyaffine::kPi * std::acos(std::min(1.0, cosine)));
  }
  return out;
}

std::vector<AngleDistribution> angle_distribution(const TetMesh& mesh,
                                                  const VentricularCoordinates& coordinates,
                                                  const std::vector<double>& angle_deg) {
  const auto* right = coordinates.right();
  std::array<std::vector<Weighted>, 3> regions;
  for (int t = 0; t < mesh.num_tets(); ++t)
    regions[right ? region_of(*right, t) : 0].push_back({angle_deg[t], mesh.tet_volume(t)});
  const std::array<const char*, 3> names{right ? "left free wall" : "wall", "right free wall", "septum"};
  std::vector<AngleDistribution> out;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (!regions[k].empty()) out.push_back(describe(names[k], std::move(regions[k])));
  return out;
}

}  // namespace cardiac
