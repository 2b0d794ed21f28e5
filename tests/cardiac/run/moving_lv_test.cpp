#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "support/heart_run.hpp"

// The shipped heart that moves as in the body, within ranges about normal values: pump and pressures of a
// resting adult, strain of contours by echo (HUNT; Voigt et al. 2015) and tagging (MESA), a valve plane that
// comes down by 10 to 16 mm over an apex that stays.
namespace cardiac {
namespace {

const testing::HeartRun& moving() {
  return testing::shipped_run("moving_lv");
}

double over_the_beat(const std::function<double(const GlobalStrain&)>& number, bool largest) {
  double out = number(moving().result.instants.front().global[0]);
  for (const Instant& instant : moving().result.instants) {
    const double now = number(instant.global[0]);
    out = largest ? std::max(out, now) : std::min(out, now);
  }
  return out;
}

double most(double GlobalStrain::*number) {
  return over_the_beat([number](const GlobalStrain& g) { return g.*number; }, true);
}

void expect_within(double value, double low, double high, const char* what) {
  EXPECT_GE(value, low) << what;
  EXPECT_LE(value, high) << what;
}

TEST(MovingVentricle, PumpsAsAHealthyOne) {
  ASSERT_TRUE(moving().path.completed) << moving().path.stop_reason;
  const VentricleSummary& lv = moving().result.ventricles[0];
  expect_within(lv.ef_percent, 55, 65, "ejection fraction");
  expect_within(lv.peak_pressure_mmHg, 110, 130, "peak pressure");
  expect_within(lv.edp_mmHg, 6, 12, "end-diastolic pressure");
  expect_within(lv.haemodynamics->dp_dt_max_mmHg_per_s, 1200, 2200, "dP/dt");
  expect_within(lv.haemodynamics->cardiac_output_L_per_min, 4, 6.5, "output");
}

TEST(MovingVentricle, ItsBaseComesDownAndItsApexStays) {
  expect_within(most(&GlobalStrain::base_excursion_mm), 10, 16, "excursion of the base");
  EXPECT_LT(most(&GlobalStrain::apex_motion_mm), 4);
}

TEST(MovingVentricle, ItsStrainIsThatOfClinics) {
  const auto least = [](LayerStrain GlobalStrain::*layers, double LayerStrain::*layer) {
    return over_the_beat([=](const GlobalStrain& g) { return g.*layers.*layer; }, false);
  };
  expect_within(least(&GlobalStrain::longitudinal, &LayerStrain::endocardial_percent), -22, -17, "GLS");
  expect_within(least(&GlobalStrain::circumferential, &LayerStrain::midwall_percent), -22, -16, "GCS");
  expect_within(most(&GlobalStrain::grs_percent), 25, 60, "GRS");
  expect_within(most(&GlobalStrain::twist_deg), 8, 20, "twist");
}

TEST(MovingVentricle, ItsSegmentsKeepTheirVolume) {
  for (const Instant& instant : moving().result.instants)
    for (const SegmentStrain& s : instant.strain) EXPECT_NEAR(s.volume_ratio, 1, 0.01);
}

}  // namespace
}  // namespace cardiac
