#include "cardiac/training/trained_rule.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/protocol/build_anatomy.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <polyaffine/solve/load_stepping.hpp>

namespace cardiac {
namespace {

using polyaffine::Vector;

// Five frames with a contracting wall of Guccione's law on a coarse ellipsoid.
constexpr auto kProtocol = R"(
[mesh]
shape = "land_ellipsoid"
[reduction]
preset = "fast"
ring_nodes = [4]
integration = "trained"
[tissue]
law = "guccione"
bulk_modulus_kPa = 300.0
bfs = 4.0
[fibres]
endo_angle_deg = 60.0
epi_angle_deg = -60.0
[contraction]
contractility_kPa = 150.0
cross_fibre_fraction = 0.0
[activation]
mode = "uniform"
[cavities]
pressure_mmHg = 90.0
)";

class TrainedRules : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::filesystem::remove_all(folder());
    setenv("XDG_CACHE_HOME", folder().c_str(), 1);
    protocol = parse_protocol(kProtocol, "test");
    auto mesh = structured_ellipsoid(land_ellipsoid(), {6, 12, 1});
    anatomy =
        std::make_shared<const Anatomy>(build_anatomy(std::move(mesh.mesh), protocol, {mesh.midpoints, {}}));
    ventricle = build_ventricle(anatomy, protocol, protocol::Method::polyaffine);
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder()); }
  static std::filesystem::path folder() {
    return std::filesystem::path(::testing::TempDir()) / "trained_rule_test";
  }

  static inline Protocol protocol;
  static inline std::shared_ptr<const Anatomy> anatomy;
  static inline Ventricle ventricle;
};

// Segments 8 and 9 without tension, at a pressure and tension of its own.
Ventricle with_scar(const std::shared_ptr<const Anatomy>& anatomy, Protocol protocol) {
  protocol::RegionOverride scar;
  scar.segments = {8, 9};
  scar.tension_factor = 0.1;
  scar.stiffness_factor = 3;
  protocol.regions = {scar};
  return build_ventricle(anatomy, protocol, protocol::Method::polyaffine);
}

constexpr double kPressure = 8, kClock = 300;  // kPa; ms, in the middle of contraction

Vector equilibrium(const Ventricle& v) {
  Vector c = Vector::Zero(v.num_coefficients());
  const auto system = loaded_ventricle(v, {Vector{{kPressure}}, v.contraction->tension(kClock)});
  EXPECT_TRUE(polyaffine::load_stepping(system, *system.make_linear(), c).converged());
  return c;
}

double displacement_difference(const Ventricle& v, const Vector& a, const Vector& b) {
  const auto& points = v.all_points->discretisation.points;
  const polyaffine::DisplacementMap map(*v.discretisation.basis, points.tet, points.barycentric);
  return (map.apply(a) - map.apply(b)).norm() / map.apply(a).norm();
}

TEST_F(TrainedRules, KeepFewPointsWithPositiveWeightsAndTheVolume) {
  const auto& few = ventricle.discretisation.points;
  const auto& all = ventricle.all_points->discretisation.points;
  EXPECT_LT(few.tet.size(), 0.8 * static_cast<double>(all.tet.size()));
  EXPECT_LT(2 * ventricle.discretisation.cavities[0].points.tet.size(),
            ventricle.all_points->discretisation.cavities[0].points.tet.size());
  EXPECT_GT(few.weights.minCoeff(), 0);
  EXPECT_GT(ventricle.discretisation.cavities[0].points.weights.minCoeff(), 0);
  EXPECT_NEAR(few.weights.sum() / all.weights.sum(), 1, 0.005);
  const Vector rest = Vector::Zero(ventricle.num_coefficients());
  EXPECT_NEAR(ventricle.cavity_volume(rest) / ventricle.all_points->cavity_volume(rest), 1, 0.005);
}

TEST_F(TrainedRules, AnUntrainedScarComesOutAsWithAllPoints) {
  const Ventricle scar = with_scar(anatomy, protocol);
  EXPECT_EQ(scar.discretisation.points.weights, ventricle.discretisation.points.weights);  // the same rule
  const Vector few = equilibrium(scar), all = equilibrium(*scar.all_points);
  const double difference = displacement_difference(scar, all, few);
  EXPECT_LT(difference, 0.02);
  EXPECT_GT(difference, 0);
  EXPECT_NEAR(scar.cavity_volume(few) / scar.all_points->cavity_volume(all), 1, 0.01);
  // The check sees how far the rule is off, to first order.
  const double told = rule_error(scar, {0, few, {}, Vector{{kPressure}}}, kClock);
  EXPECT_NEAR(told / difference, 1, 0.3);
  EXPECT_LT(told, kTrustedRuleError);
}

TEST_F(TrainedRules, TheCheckFindsARuleThatIsOff) {
  TrainedRule rule = cached_rule(anatomy, protocol);
  for (Eigen::Index i = 0; i < rule.wall.weights.size(); i += 2) rule.wall.weights[i] *= 0.7;
  Ventricle off =
      assemble_ventricle(anatomy, protocol, with_rule(ventricle.all_points->discretisation, rule));
  off.all_points = ventricle.all_points;
  EXPECT_GT(rule_error(off, {0, equilibrium(off), {}, Vector{{kPressure}}}, kClock), kTrustedRuleError);
}

TEST_F(TrainedRules, TheCacheKeepsEveryBitAndKnowsWhatTrainingReads) {
  const TrainedRule first = train_rule(anatomy, protocol), again = cached_rule(anatomy, protocol);
  EXPECT_EQ(first.wall.points, again.wall.points);
  EXPECT_EQ(first.wall.weights, again.wall.weights);
  EXPECT_EQ(first.cavity.weights, again.cavity.weights);
  const auto files = [] {
    return std::distance(std::filesystem::directory_iterator(folder() / "cardiac"), {});
  };
  const auto before = files();
  Protocol other = protocol;
  other.time.duration_ms = 700;
  cached_rule(anatomy, other);
  EXPECT_EQ(files(), before);
  other.tissue.C_kPa = 3;
  cached_rule(anatomy, other);
  EXPECT_EQ(files(), before + 1);
}

}  // namespace
}  // namespace cardiac
