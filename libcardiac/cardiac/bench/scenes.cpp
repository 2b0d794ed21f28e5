#include <cmath>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/bench/scene.hpp>

namespace cardiac {
namespace {

// μ = E / (2 (1 + ν)), κ = E / (3 (1 − 2ν)) of E = 10, ν = 0.49.
constexpr auto kPassive = R"(
[mesh]
shape = "land_ellipsoid"
[tissue]
law = "neo_hookean"
mu_kPa = 3.3557046979865772
bulk_modulus_kPa = 166.66666666666666
[cavities]
pressure_mmHg = 7.5
)";

constexpr auto kEndSystole = R"(
[mesh]
shape = "land_ellipsoid"
[tissue]
law = "guccione"
C_kPa = 2.0
bf = 8.0
bt = 2.0
bfs = 4.0
bulk_modulus_kPa = 300.0
viscosity_kPa_ms = 0.0
[fibres]
endo_angle_deg = 60.0
epi_angle_deg = -60.0
[activation]
mode = "uniform"
[contraction]
[cavities]
pressure_mmHg = 101.26
)";

constexpr double kTension = 75, kPressure = 13.5, kScarTension = 0.2, kScarBorder = 0.1;

double healthy_tension(const Vec3&) {
  return kTension;
}

double scar_tension(const Vec3& X) {
  return kTension *
         (1 - (1 - kScarTension) * ellipsoid_segment_share(land_ellipsoid(), {7, 8}, kScarBorder, X));
}

}  // namespace

double ellipsoid_segment_share(const TruncatedEllipsoid& shape, const std::vector<int>& segments,
                               double border, const Vec3& X) {
  const double height = (X.z() + shape.endo_long_mm) / (shape.base_z_mm + shape.endo_long_mm);
  const auto shares = segment_shares(height, std::atan2(X.x(), X.y()), border);
  double sum = 0;
  for (const int s : segments) sum += shares[s - 1];
  return sum;
}

const std::vector<BenchScene>& bench_scenes() {
  static const std::vector<BenchScene> scenes{
      {"ellipsoid_passive", "Passive inflation", land_ellipsoid(), kPassive, {{1.0}}},
      {"end_systole", "End systole", land_ellipsoid(), kEndSystole, {{kPressure, healthy_tension}}},
      {"end_systole_scar",
       "End systole with a scar",
       land_ellipsoid(),
       kEndSystole,
       {{kPressure, healthy_tension}, {kPressure, scar_tension}}},
  };
  return scenes;
}

}  // namespace cardiac
