#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <cardiac/contraction/bestel_2001.hpp>
#include <cardiac/validation/elastodynamics.hpp>
#include <cardiac/validation/elastodynamics_curves.hpp>
#include <polyaffine/core/error.hpp>

#include "support/temporary_folder.hpp"

namespace cardiac {
namespace {

using polyaffine::Vec3;
using ::testing::HasSubstr;

// Published peaks: 16.07 kPa of the pressure, 118.1 kPa of the tension.
TEST(Elastodynamics, LoadsHaveTheirPublishedPeaks) {
  const BenchmarkPressureCurve pressure({}, 1000);
  double peak = 0;
  for (int t = 0; t <= 1000; ++t) peak = std::max(peak, pressure.at(t));
  EXPECT_NEAR(peak, 16.07, 0.01);
  EXPECT_EQ(pressure.at(0), 0);
  EXPECT_NEAR(TensionCurve(BestelParameters{}, 1000).peak_tension(), 118.1, 0.1);
}

TEST(Elastodynamics, PressureObeysItsEquation) {
  const BenchmarkPressure parameters{16, 12, 15};
  const BenchmarkPressureCurve pressure(parameters, 600);
  for (const double t : {100.25, 200.25, 350.25, 520.25}) {  // between samples, where it is linear
    const double slope = (pressure.at(t + 0.2) - pressure.at(t - 0.2)) / 0.4;
    EXPECT_NEAR(slope, pressure_rate(parameters, t, pressure.at(t)), 2e-4) << t;
  }
}

// A run of one point that goes 1 mm beyond the range at one instant.
TEST(Elastodynamics, ExcessOverTheRangeOfTheGroups) {
  ElastodynamicsRun run;
  run.times_ms = polyaffine::Vector::LinSpaced(101, 0, 100);
  run.displacements = {polyaffine::Points::Zero(3, 101)};
  run.displacements[0](0, 30) = 3;
  GroupEnvelope envelope{polyaffine::Vector::LinSpaced(11, 0, 100), {}};
  const polyaffine::Vector one = polyaffine::Vector::Ones(11);
  envelope.points.push_back(
      {GroupCurves{0 * one, -one, 2 * one}, {0 * one, -one, one}, {one, 0.5 * one, 2 * one}});
  const auto found = excess(run, envelope);
  EXPECT_NEAR(found[0][0].largest_mm, 1, 1e-15);
  EXPECT_EQ(found[0][0].at_ms, 30);
  EXPECT_NEAR(found[0][0].share_inside, 10.0 / 11, 1e-15);
  EXPECT_EQ(found[0][1].largest_mm, 0);
  EXPECT_NEAR(found[0][2].largest_mm, 0.5, 1e-15);
  EXPECT_NEAR(found[0][2].rms_to_median_mm, 1, 1e-15);
}

TEST(Elastodynamics, ScenesAreTheBenchmarks) {
  const Scene scene = elastodynamics_scene(elastodynamics_cases().back(), {});
  EXPECT_EQ(scene.boundary.base, scene::Base::elastic);
  EXPECT_EQ(scene.boundary.base_inplane_stiffness_kPa_per_mm, 1);  // 10⁶ Pa/m
  EXPECT_EQ(scene.boundary.epicardial_stiffness_kPa_per_mm, 100);  // 10⁸ Pa/m
  EXPECT_EQ(scene.tissue.density_mg_per_mm3, 1);
}

TEST(Elastodynamics, StructuredVentricleHasTheBenchmarksShape) {
  const auto anatomy = structured_benchmark_ventricle({6, 8, 1});
  // Apex along −x, rings of the base at x = 26.47 (inside) and 24.25 mm.
  EXPECT_NEAR(anatomy->mesh.points().row(0).minCoeff(), -97, 1e-9);
  EXPECT_NEAR(anatomy->mesh.points().row(0).maxCoeff(), 26.47, 1e-9);
  EXPECT_GT(anatomy->coordinates->axis().x(), 0.99);
  const FibreAxes axes = anatomy->fibres(*anatomy->coordinates, {0}, polyaffine::Vec4::Constant(0.25));
  EXPECT_NEAR((axes.reshaped(3, 3).transpose() * axes.reshaped(3, 3) - polyaffine::Mat3::Identity()).norm(),
              0, 1e-12);
}

TEST(Elastodynamics, AbsentMeshesAreNamedOrLeftOut) {
  const TemporaryFolder folder;
  ValidationContext context;
  context.hearts = folder.path;
  context.out = folder.path;
  std::string told;
  context.left_out = [&](const std::string& why) { told = why; };
  EXPECT_TRUE(validate_elastodynamics(context).empty());
  EXPECT_THAT(told, HasSubstr("lv_surface.vtu: not found"));
  context.named = true;
  EXPECT_THROW(validate_elastodynamics(context), polyaffine::InputError);
}

}  // namespace
}  // namespace cardiac
