#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <cardiac/core/units.hpp>
#include <cardiac/heart/verification.hpp>
#include <cardiac/strain/segment_strain.hpp>
#include <polyaffine/kinematics/lagrange.hpp>

#include "support/heart_run.hpp"

namespace cardiac {
namespace {

using polyaffine::Points;
using polyaffine::Vec4;
using polyaffine::Vector;
using testing::HeartRun;

/// Displacement at points inside the tets, one a tet.
Points displacement(const HeartRun& run, const Vector& c) {
  const int n = run.ventricle.anatomy->mesh.num_tets();
  std::vector<int> tet(n);
  for (int t = 0; t < n; ++t) tet[t] = t;
  const Eigen::Matrix4Xd middle = Eigen::Matrix4Xd::Constant(4, n, 0.25);
  return polyaffine::DisplacementMap(*run.ventricle.discretisation.basis, tet, middle).apply(c);
}

/// The same passive inflation of the coarse Land ellipsoid, reduced and full order.
struct Inflations {
  HeartRun reduced, full;

  static const Inflations& get() {
    static const auto protocol = [](const std::string& method) {
      return testing::shipped_protocol(
          "passive_inflation",
          testing::on_land_ellipsoid({"reduction.method=" + method, "time.load_steps=3"}));
    };
    static const Inflations both = [] {
      const auto anatomy = testing::read_anatomy(protocol("fem"));
      return Inflations{HeartRun(protocol("polyaffine"), anatomy), HeartRun(protocol("fem"), anatomy)};
    }();
    return both;
  }
};

TEST(Prescribed, PressureRisesToTheOneAskedForAndTheCavityWithIt) {
  for (const HeartRun* run : {&Inflations::get().reduced, &Inflations::get().full}) {
    SCOPED_TRACE(run->result.method);
    const auto& outputs = run->path.outputs;
    ASSERT_TRUE(run->path.completed) << run->path.stop_reason;
    ASSERT_GE(outputs.size(), 4);  // three steps and the beginning
    EXPECT_EQ(outputs.front().pressure_kPa, 0);
    EXPECT_EQ(outputs.front().c.norm(), 0);
    EXPECT_NEAR(outputs.back().pressure_kPa, 7.5 * kPa_per_mmHg, 1e-12);
    EXPECT_NEAR(run->result.ventricles[0].peak_pressure_mmHg, 7.5, 1e-9);
    EXPECT_NEAR(outputs.back().time_ms, run->protocol.time.duration_ms, 1e-9);
    for (std::size_t k = 1; k < outputs.size(); ++k) {
      EXPECT_GT(outputs[k].pressure_kPa, outputs[k - 1].pressure_kPa);
      EXPECT_GT(outputs[k].volume_mm3, outputs[k - 1].volume_mm3);
    }
    EXPECT_FALSE(run->result.has_beat);
    EXPECT_GT(run->result.min_det_F, 0.7);
    EXPECT_LT(run->result.max_det_F, 1.4);
  }
}

// The wall at rest is in equilibrium with no pressure, and next to it with next to none.
TEST(Prescribed, NoPressureMovesNothingAndALittleALittle) {
  const auto run_at = [](const std::string& pressure_mmHg) {
    return HeartRun(testing::shipped_protocol(
        "passive_inflation",
        testing::on_land_ellipsoid({"cavities.pressure_mmHg=" + pressure_mmHg, "tissue.law=guccione",
                                    "fibres.endo_angle_deg=60", "time.load_steps=2"})));
  };
  const auto opened = [&](const std::string& pressure_mmHg) {
    const HeartRun run = run_at(pressure_mmHg);
    EXPECT_TRUE(run.path.completed) << run.path.stop_reason;
    return run.path.steps.back().volume_mm3 - run.path.steps.front().volume_mm3;
  };
  EXPECT_NEAR(opened("0.0"), 0, 1e-9);
  const HeartRun still = run_at("0.0");
  for (const auto& instant : verify_path(still.ventricle, still.protocol, still.path))
    EXPECT_EQ(instant.displacement_error_percent, 0) << instant.instant;
  const double compliance = opened("1e-3") / 1e-3;  // mm³/mmHg
  EXPECT_GT(compliance, 10);
  EXPECT_NEAR(opened("1e-6") / 1e-6, compliance, 1e-2 * compliance);
  EXPECT_NEAR(opened("1e-9") / 1e-9, compliance, 1e-2 * compliance);
}

TEST(Prescribed, ABeatBeginsWithoutFillingPressure) {
  const HeartRun run(testing::shipped_protocol(
      "healthy_lv",
      testing::on_land_ellipsoid({"circulation.filling_pressure_mmHg=0.0", "time.max_beats=1"})));
  EXPECT_TRUE(run.path.completed) << run.path.stop_reason;
}

TEST(Prescribed, ReducedModelFollowsTheFullOrder) {
  const auto& [reduced, full] = Inflations::get();
  const Points u = displacement(reduced, reduced.path.steps.back().c);
  const Points v = displacement(full, full.path.steps.back().c);
  EXPECT_GT(v.colwise().norm().maxCoeff(), 2);  // mm: a large deformation
  EXPECT_LT((u - v).norm(), 0.12 * v.norm());   // what 17 frames leave
  EXPECT_GT(u.cwiseProduct(v).sum(), 0);
  const double grown = full.path.steps.back().volume_mm3 / full.path.steps.front().volume_mm3;
  EXPECT_GT(grown, 1.3);
  EXPECT_NEAR(reduced.path.steps.back().volume_mm3 / reduced.path.steps.front().volume_mm3, grown,
              0.06 * grown);
  // Inflation lengthens along the wall and thins it, in both.
  for (const HeartRun* run : {&reduced, &full}) {
    EXPECT_GT(run->result.strain.gls_percent, 0);
    EXPECT_GT(run->result.strain.gcs_percent, 0);
    EXPECT_LT(run->result.strain.grs_percent, 0);
    EXPECT_LT(std::abs(run->result.strain.twist_deg), 0.5);  // isotropic: no twist but that of the mesh
  }
}

TEST(Prescribed, VerificationIsTheDirectComparison) {
  const auto& [reduced, full] = Inflations::get();
  const auto instants = verify_path(reduced.ventricle, reduced.protocol, reduced.path);
  ASSERT_EQ(instants.size(), 2);
  EXPECT_EQ(instants[0].instant, "ED");
  EXPECT_EQ(instants[1].instant, "ES");
  for (const VerificationInstant& i : instants) {
    EXPECT_TRUE(std::isfinite(i.displacement_error_percent)) << i.instant;
    EXPECT_TRUE(std::isfinite(i.volume_error_percent)) << i.instant;
    EXPECT_TRUE(std::isfinite(i.max_segment_strain_error)) << i.instant;
    EXPECT_GE(i.wall_time_s, 0);
  }
  // At the beginning both are unloaded.
  EXPECT_EQ(instants[0].displacement_error_percent, 0);
  // At the end: against the full-order run, which came there by its own path, at its own points.
  const auto& points = full.ventricle.discretisation.points;
  const auto at_points = [&](const HeartRun& run) {
    return polyaffine::DisplacementMap(*run.ventricle.discretisation.basis, points.tet, points.barycentric)
        .apply(run.path.steps.back().c);
  };
  const Points v = at_points(full);
  const Vector error = (at_points(reduced) - v).colwise().squaredNorm();
  const Vector size = v.colwise().squaredNorm();
  const double direct = 100 * std::sqrt(points.weights.dot(error) / points.weights.dot(size));
  EXPECT_GT(direct, 0.1);
  EXPECT_NEAR(instants[1].displacement_error_percent, direct, 0.01 * direct);
  const double volume = 100 * (reduced.path.steps.back().volume_mm3 / full.path.steps.back().volume_mm3 - 1);
  EXPECT_NEAR(instants[1].volume_error_percent, volume, 0.01);
  // Strains of the runs' own instants are averaged over other points: the same size, not the same number.
  const auto& a = reduced.result.instants.back().strain;
  const auto& b = full.result.instants.back().strain;
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    largest = std::max({largest, std::abs(a[k].longitudinal - b[k].longitudinal),
                        std::abs(a[k].circumferential - b[k].circumferential),
                        std::abs(a[k].radial - b[k].radial)});
  EXPECT_GT(instants[1].max_segment_strain_error, largest / 2);
  EXPECT_LT(instants[1].max_segment_strain_error, 2 * largest);
}

TEST(Prescribed, ContractionAgainstAHeldPressureEmptiesAndRefills) {
  const Protocol protocol = parse_protocol(R"(
mesh = {file = "../meshes/land_ellipsoid_coarse.vtu", length_unit = "mm"}
tissue = {law = "guccione"}
fibres = {}
activation = {mode = "uniform", onset_ms = 100}
contraction = {model = "bestel_clement_sorine_simplified", contractility_kPa = 40}
cavities = {pressure_mmHg = 10}
time = {load_steps = 20, duration_ms = 900}
)",
                                           PROJECT_DIR "/protocols/twitch.toml");
  const HeartRun run(protocol);
  ASSERT_TRUE(run.path.completed) << run.path.stop_reason;
  const auto& outputs = run.path.outputs;
  EXPECT_EQ(outputs.front().time_ms, 0);
  EXPECT_NEAR(outputs.back().time_ms, 900, 1e-9);
  const double filled = outputs.front().volume_mm3;
  double least = filled, when = 0;
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    ASSERT_TRUE(outputs[k].c.allFinite());
    EXPECT_NEAR(outputs[k].pressure_kPa, 10 * kPa_per_mmHg, 1e-12);
    if (k > 0) {
      EXPECT_GT(outputs[k].time_ms, outputs[k - 1].time_ms);
    }
    if (outputs[k].volume_mm3 < least) {
      least = outputs[k].volume_mm3;
      when = outputs[k].time_ms;
    }
  }
  EXPECT_GT(filled, run.ventricle.cavity_volume(Vector::Zero(run.ventricle.num_coefficients())));
  EXPECT_LT(least, 0.7 * filled);
  EXPECT_GT(when, 100);
  EXPECT_LT(when, 500);
  EXPECT_NEAR(outputs.back().volume_mm3, filled, 0.02 * filled);  // relaxed again
  EXPECT_EQ(run.ventricle.built.count("contraction"), 1);
  EXPECT_FALSE(run.path.built.contains("circulation"));
}

}  // namespace
}  // namespace cardiac
