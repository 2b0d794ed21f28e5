#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/bench/scene.hpp>
#include <cardiac/core/units.hpp>

namespace cardiac {
namespace {

constexpr double kYoung = 10, kPoisson = 0.49;
constexpr double kCompliancePressure = 0.02;  // kPa: strains of a per cent

// μ = E / (2 (1 + ν)), κ = E / (3 (1 − 2ν)).
std::string neo_hookean(double poisson, double pressure_kPa) {
  std::ostringstream out;
  out << std::setprecision(17)
      << "[mesh]\nshape = \"land_ellipsoid\"\n[tissue]\nlaw = \"neo_hookean\"\nmu_kPa = "
      << kYoung / (2 * (1 + poisson)) << "\nbulk_modulus_kPa = " << kYoung / (3 * (1 - 2 * poisson))
      << "\n[cavities]\npressure_mmHg = " << pressure_kPa / kPa_per_mmHg << "\n";
  return out.str();
}

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
contractility_kPa = 150.0
cross_fibre_fraction = 0.0
[cavities]
pressure_mmHg = 101.26
)";

constexpr double kTension = 75, kPressure = 13.5, kScarTension = 0.2, kScarBorder = 0.1;

// Tells a model that regions differ, and which; the tension itself is that of the path.
constexpr auto kScar = R"(
[[region]]
segments = [7, 8]
tension_factor = 0.2
)";

double healthy_tension(const Vec3&) {
  return kTension;
}

double scar_tension(const Vec3& X) {
  return kTension *
         (1 - (1 - kScarTension) * ellipsoid_segment_share(land_ellipsoid(), {7, 8}, kScarBorder, X));
}

// Land's wall, thicker on the side of +y and thinner opposite: the distance to the endocardium across the
// long axis times 1 + w cos ψ / 5.
double stretch(const Vec3& X) {
  const double radius = X.head<2>().norm(), height = (X.z() + 17) / 22;
  if (radius == 0 || height <= 0) return 1;
  const double w = height < 1 ? height * height * (3 - 2 * height) : 1;
  return 1 + 0.2 * w * X.y() / radius;
}

Vec3 across_from_endocardium(const Vec3& X, double factor) {
  const double radius = X.head<2>().norm();
  if (radius == 0) return X;
  const double inside = 7 * std::sqrt(std::max(0.0, 1 - X.z() * X.z() / (17 * 17)));
  const double share = (inside + factor * (radius - inside)) / radius;
  return {share * X.x(), share * X.y(), X.z()};
}

BenchScene human(BenchScene scene) {
  scene.group = scene.name = "end_systole_human";
  scene.title = "End systole of a human ventricle";
  scene.other_heart = true;
  scene.shape = human_lv();
  return scene;
}

BenchScene asymmetric(BenchScene scene) {
  scene.group = scene.name = "end_systole_asymmetric";
  scene.title = "End systole of an asymmetric wall";
  scene.other_heart = true;
  scene.to_wall = [](const Vec3& X) { return across_from_endocardium(X, stretch(X)); };
  scene.to_ellipsoid = [](const Vec3& X) { return across_from_endocardium(X, 1 / stretch(X)); };
  scene.path = {{kPressure, [](const Vec3& X) {
                   const double radius = X.head<2>().norm();
                   return kTension * (1 - (radius > 0 ? 0.2 * X.y() / radius : 0));
                 }}};
  return scene;
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
  static const std::vector<BenchScene> scenes = [] {
    const auto shape = land_ellipsoid();
    std::vector<BenchScene> out{
        {"ellipsoid_passive",
         "ellipsoid_passive",
         "Passive inflation",
         shape,
         neo_hookean(kPoisson, 1),
         {{1.0}}},
        {"end_systole", "end_systole", "End systole", shape, kEndSystole, {{kPressure, healthy_tension}}},
        {"end_systole_scar",
         "end_systole_scar",
         "End systole with a scar",
         shape,
         std::string(kEndSystole) + kScar,
         {{kPressure, healthy_tension}, {kPressure, scar_tension}}}};
    out.push_back(human(out[1]));
    out.push_back(asymmetric(out[1]));
    for (const char* poisson : {"0.3", "0.4", "0.45", "0.49", "0.499", "0.4999"})
      out.push_back({kCompliance,
                     std::string("compliance_") + poisson,
                     std::string("Compliance at Poisson's ratio ") + poisson,
                     shape,
                     neo_hookean(std::stod(poisson), kCompliancePressure),
                     {{kCompliancePressure}}});
    return out;
  }();
  return scenes;
}

}  // namespace cardiac
