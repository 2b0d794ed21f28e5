#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <cardiac/core/units.hpp>
#include <cardiac/run/plausibility.hpp>
#include <cardiac/run/verification.hpp>
#include <cardiac/strain/segment_strain.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/solve/load_stepping.hpp>

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
    EXPECT_EQ(outputs.front().pressures_kPa[0], 0);
    EXPECT_EQ(outputs.front().c.norm(), 0);
    EXPECT_NEAR(outputs.back().pressures_kPa[0], 7.5 * kPa_per_mmHg, 1e-12);
    EXPECT_NEAR(run->result.ventricles[0].peak_pressure_mmHg, 7.5, 1e-9);
    EXPECT_NEAR(outputs.back().time_ms, run->protocol.time.duration_ms, 1e-9);
    for (std::size_t k = 1; k < outputs.size(); ++k) {
      EXPECT_GT(outputs[k].pressures_kPa[0], outputs[k - 1].pressures_kPa[0]);
      EXPECT_GT(outputs[k].volumes_mm3[0], outputs[k - 1].volumes_mm3[0]);
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
    return run.path.steps.back().volumes_mm3[0] - run.path.steps.front().volumes_mm3[0];
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
  const double grown = full.path.steps.back().volumes_mm3[0] / full.path.steps.front().volumes_mm3[0];
  EXPECT_GT(grown, 1.3);
  EXPECT_NEAR(reduced.path.steps.back().volumes_mm3[0] / reduced.path.steps.front().volumes_mm3[0], grown,
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
  std::vector<std::pair<std::string, double>> told;
  const auto instants =
      verify_path(reduced.ventricle, reduced.protocol, reduced.path,
                  [&](const std::string& what, double fraction) { told.emplace_back(what, fraction); });
  ASSERT_EQ(instants.size(), 2);
  // Told at every step of Newton's method (several an instant that is loaded), the share never falling back
  // by more than a residual that rises on the way.
  const auto steps = [&](const std::string& of) {
    return std::ranges::count_if(told,
                                 [&](const auto& t) { return t.first.starts_with("full order at " + of); });
  };
  EXPECT_GE(steps("ES"), 3);
  for (const auto& [what, fraction] : told) {
    EXPECT_GE(fraction, what.find(" at ES") == std::string::npos ? 0 : 0.5) << what;
    EXPECT_LE(fraction, 1) << what;
  }
  EXPECT_GT(told.back().second, 0.6);
  EXPECT_THROW(verify_path(reduced.ventricle, reduced.protocol, reduced.path,
                           [](const std::string&, double) { throw std::runtime_error("stop"); }),
               std::runtime_error);
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
  const double volume =
      100 * (reduced.path.steps.back().volumes_mm3[0] / full.path.steps.back().volumes_mm3[0] - 1);
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
  const double filled = outputs.front().volumes_mm3[0];
  double least = filled, when = 0;
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    ASSERT_TRUE(outputs[k].c.allFinite());
    EXPECT_NEAR(outputs[k].pressures_kPa[0], 10 * kPa_per_mmHg, 1e-12);
    if (k > 0) {
      EXPECT_GT(outputs[k].time_ms, outputs[k - 1].time_ms);
    }
    if (outputs[k].volumes_mm3[0] < least) {
      least = outputs[k].volumes_mm3[0];
      when = outputs[k].time_ms;
    }
  }
  EXPECT_GT(filled, run.ventricle.cavity_volume(Vector::Zero(run.ventricle.num_coefficients())));
  EXPECT_LT(least, 0.7 * filled);
  EXPECT_GT(when, 100);
  EXPECT_LT(when, 500);
  EXPECT_NEAR(outputs.back().volumes_mm3[0], filled, 0.02 * filled);  // relaxed again
  EXPECT_EQ(run.ventricle.built.count("contraction"), 1);
  EXPECT_FALSE(run.path.built.contains("circulation"));
}

TEST(Prescribed, ContractionFollowsTheHeartRateTheIntervalAndTheViscosity) {
  const auto run = [](const std::string& viscosity) {
    return HeartRun(parse_protocol(R"(
mesh = {file = "../meshes/land_ellipsoid_coarse.vtu", length_unit = "mm"}
tissue = {law = "guccione", bfs = 20, bulk_modulus_kPa = 1000, viscosity_kPa_ms = )" +
                                       viscosity + R"(}
fibres = {}
activation = {}
contraction = {contractility_kPa = 30}
cavities = {pressure_mmHg = 5}
time = {heart_rate_bpm = 75, duration_ms = 1600}
output = {interval_ms = 5}
)",
                                   PROJECT_DIR "/protocols/two_beats.toml"));
  };
  const HeartRun beats = run("100");
  ASSERT_TRUE(beats.path.completed) << beats.path.stop_reason;
  const auto& outputs = beats.path.outputs;
  ASSERT_EQ(outputs.size(), 321U);
  for (std::size_t k = 0; k < outputs.size(); ++k)
    EXPECT_NEAR(outputs[k].time_ms, 5.0 * static_cast<double>(k), 1e-6);
  // The second contraction repeats the first, 800 ms later.
  const auto least = [&](std::size_t from, std::size_t to) {
    return std::min_element(
        outputs.begin() + from, outputs.begin() + to,
        [](const HeartState& a, const HeartState& b) { return a.volumes_mm3[0] < b.volumes_mm3[0]; });
  };
  const auto first = least(0, 160), second = least(160, 321);
  EXPECT_NEAR(second->time_ms - first->time_ms, 800, 5.1);
  EXPECT_NEAR(second->volumes_mm3[0], first->volumes_mm3[0], 0.002 * first->volumes_mm3[0]);
  EXPECT_LT(first->volumes_mm3[0], 0.8 * outputs.front().volumes_mm3[0]);
  // End systole is the smallest volume after the last onset of contraction.
  EXPECT_EQ(beats.key.ed_is, "onset of contraction");
  EXPECT_NEAR(beats.key.ed.time_ms, 900, 5);
  EXPECT_EQ(beats.key.es_is, "smallest volume");
  EXPECT_NEAR(beats.key.es.volumes_mm3[0], second->volumes_mm3[0], 0.001 * second->volumes_mm3[0]);
  EXPECT_NEAR(beats.key.es.time_ms, second->time_ms, 15);
  EXPECT_LT(beats.result.strain.gcs_percent, -5);
  // Viscosity delays the motion: while the tension rises the volume is larger than without it; in the end
  // both are the same.
  const HeartRun inviscid = run("0"), viscous = run("400");
  ASSERT_TRUE(inviscid.path.completed) << inviscid.path.stop_reason;
  const auto rising = static_cast<std::size_t>(150 / 5);
  EXPECT_GT(viscous.path.outputs[rising].volumes_mm3[0], 1.01 * inviscid.path.outputs[rising].volumes_mm3[0]);
  EXPECT_NEAR(viscous.path.outputs.back().volumes_mm3[0], inviscid.path.outputs.back().volumes_mm3[0],
              0.01 * inviscid.path.outputs.back().volumes_mm3[0]);
  // Without viscosity every state is an equilibrium of its own: solved statically from the unloaded wall.
  const HeartState& es = inviscid.key.es;
  const auto system = loaded_ventricle(
      inviscid.ventricle, {es.pressures_kPa, inviscid.ventricle.contraction->tension(es.time_ms)});
  Vector c = Vector::Zero(inviscid.ventricle.num_coefficients());
  ASSERT_TRUE(polyaffine::load_stepping(system, *system.make_linear(), c, {}).converged());
  EXPECT_NEAR(inviscid.ventricle.cavity_volume(c), es.volumes_mm3[0], 0.002 * es.volumes_mm3[0]);
}

TEST(Prescribed, WithoutACavityEndSystoleIsTheEndOfContraction) {
  const HeartRun run(parse_protocol(R"(
mesh = {file = "../meshes/land_ellipsoid_coarse.vtu", length_unit = "mm"}
tissue = {bfs = 20}
fibres = {}
activation = {}
contraction = {contractility_kPa = 20}
time = {duration_ms = 600}
output = {interval_ms = 50}
)",
                                    PROJECT_DIR "/protocols/free_contraction.toml"));
  ASSERT_TRUE(run.path.completed) << run.path.stop_reason;
  EXPECT_EQ(run.key.es_is, "end of contraction");
  EXPECT_NEAR(run.key.es.time_ms - run.key.ed.time_ms, 324, 10);
  EXPECT_LT(run.result.strain.gcs_percent, -3);
  // No cavity, no volume: an empty cell, not zero, and nothing absurd.
  EXPECT_TRUE(std::isnan(run.result.ventricles[0].samples.back().volume_mL));
  EXPECT_TRUE(absurdities(run.result).empty());
}

}  // namespace
}  // namespace cardiac
