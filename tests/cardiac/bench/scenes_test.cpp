#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/bench/scene.hpp>
#include <cardiac/protocol/protocol.hpp>

namespace cardiac {
namespace {

// What a scene is, told by its protocol and its loads, not by its name.
TEST(BenchScenes, CoverFillingContractionScarsOtherHeartsAndLocking) {
  std::set<std::string> names, groups;
  int contracting = 0, with_scar = 0, other_hearts = 0, human = 0, bent = 0;
  double softest = 0.5;  // the largest compressibility left, 1/2 − ν
  for (const BenchScene& scene : bench_scenes()) {
    SCOPED_TRACE(scene.name);
    EXPECT_TRUE(names.insert(scene.name).second);
    groups.insert(scene.group);
    EXPECT_FALSE(scene.title.empty());
    const Protocol protocol = parse_protocol(scene.protocol, scene.name);
    ASSERT_FALSE(scene.path.empty());
    for (const SceneLoad& load : scene.path) {
      EXPECT_EQ(load.tension_kPa != nullptr, protocol.contraction.has_value());
      EXPECT_EQ(load.pressure_kPa, scene.path.front().pressure_kPa);
    }
    // The pressure of the protocol is told in mmHg, of which 1 kPa has 7.5006.
    EXPECT_NEAR(protocol.cavities->pressure_kPa, scene.path.back().pressure_kPa,
                1e-4 * protocol.cavities->pressure_kPa);
    contracting += protocol.contraction.has_value();
    with_scar += !protocol.regions.empty();
    other_hearts += scene.other_heart;
    human += scene.shape.endo_long_mm != land_ellipsoid().endo_long_mm;
    bent += scene.to_wall != nullptr;
    if (protocol.tissue.law == protocol::TissueLaw::neo_hookean) {
      const double mu = protocol.tissue.mu_kPa, kappa = protocol.tissue.bulk_modulus_kPa;
      softest = std::min(softest, 0.5 - (3 * kappa - 2 * mu) / (6 * kappa + 2 * mu));
    }
  }
  EXPECT_EQ(contracting, 4);
  EXPECT_EQ(with_scar, 1);
  EXPECT_EQ(other_hearts, 2);
  EXPECT_EQ(human, 1);
  EXPECT_EQ(bent, 1);
  EXPECT_NEAR(softest, 1e-4, 1e-6);
  EXPECT_EQ(groups.size(), 6);
  EXPECT_TRUE(groups.contains(kCompliance));
}

TEST(BenchScenes, AreValidProtocolsWithTheConstantsOfTheTask) {
  const auto law = [](std::size_t k) { return parse_protocol(bench_scenes()[k].protocol, "scene").tissue; };
  EXPECT_NEAR(law(0).mu_kPa, 10 / (2 * 1.49), 1e-12);
  EXPECT_NEAR(law(0).bulk_modulus_kPa, 10 / (3 * (1 - 2 * 0.49)), 1e-9);
  EXPECT_NEAR(law(5).bulk_modulus_kPa, 10 / (3 * 0.4), 1e-9);
  EXPECT_NEAR(law(10).bulk_modulus_kPa, 10 / (3 * 0.0002), 1e-6);
  for (const std::size_t k : {1, 2, 3, 4}) {
    EXPECT_EQ(law(k).law, protocol::TissueLaw::guccione);
    EXPECT_EQ(law(k).bulk_modulus_kPa, 300);
    EXPECT_EQ(law(k).viscosity_kPa_ms, 0);
    EXPECT_EQ(bench_scenes()[k].path.back().pressure_kPa, 13.5);
  }
}

// Directions about the axis: anterior +y, septum +x.
Vec3 place(double height, double psi_deg) {
  const double psi = psi_deg * polyaffine::kPi / 180;
  return {8 * std::sin(psi), 8 * std::cos(psi), -17 + 22 * height};
}

TEST(BenchScenes, ScarWeakensSegmentsSevenAndEight) {
  const auto& scar = bench_scenes()[2].path;
  EXPECT_EQ(scar[0].tension_kPa(place(0.5, 0)), 75);
  EXPECT_NEAR(scar[1].tension_kPa(place(0.5, 0)), 15, 1e-9);       // mid anterior
  EXPECT_NEAR(scar[1].tension_kPa(place(0.5, 60)), 15, 1e-9);      // mid anteroseptal
  EXPECT_NEAR(scar[1].tension_kPa(place(0.5, -60)), 75, 1e-9);     // mid anterolateral
  EXPECT_NEAR(scar[1].tension_kPa(place(0.85, 0)), 75, 1e-9);      // basal anterior
  EXPECT_NEAR(scar[1].tension_kPa(place(0.5, 90)), 45, 1e-9);      // half way on the border 8|9
  EXPECT_NEAR(scar[1].tension_kPa(place(0.5, 90 + 7)), 75, 1e-9);  // the border is 6° wide
}

TEST(BenchScenes, AsymmetricWallVariesInThicknessAndTensionByFortyPercent) {
  const BenchScene& scene = bench_scenes()[4];
  const auto thickness = [&](double psi_deg) {
    const double psi = psi_deg * polyaffine::kPi / 180;
    const Vec3 out(std::sin(psi), std::cos(psi), 0);  // at z = 0
    return (scene.to_wall(10 * out + 5 * Vec3::UnitZ()) - scene.to_wall(7 * out + 5 * Vec3::UnitZ())).norm();
  };
  EXPECT_NEAR(thickness(0) / thickness(90), 1.2, 0.02);  // the plane cuts the ellipsoids at other radii
  EXPECT_NEAR(thickness(180) / thickness(90), 0.8, 0.02);
  EXPECT_NEAR(scene.path[0].tension_kPa({0, 8, 0}), 60, 1e-9);
  EXPECT_NEAR(scene.path[0].tension_kPa({0, -8, 0}), 90, 1e-9);
  for (double height = -0.1; height <= 1; height += 0.1)
    for (double psi = -180; psi < 180; psi += 40) {
      const Vec3 X = place(height, psi);
      EXPECT_LT((scene.to_ellipsoid(scene.to_wall(X)) - X).norm(), 1e-12);
    }
}

TEST(BenchScenes, SegmentsAreThoseOfTheMesh) {
  const CurvedMesh mesh = structured_ellipsoid(land_ellipsoid(), {6, 12, 2});
  const VentricularCoordinates coordinates(mesh.mesh, {}, {});
  for (int t = 0; t < mesh.mesh.num_tets(); ++t) {
    const Vec3 X = mesh.mesh.tet_centroid(t);
    const auto shares = segment_shares(coordinates.long_axis_height(X), coordinates.angle(X), 0.1);
    for (const int s : {1, 8, 16, 17})
      EXPECT_NEAR(ellipsoid_segment_share(land_ellipsoid(), {s}, 0.1, X), shares[s - 1], 1e-9);
  }
}

}  // namespace
}  // namespace cardiac
