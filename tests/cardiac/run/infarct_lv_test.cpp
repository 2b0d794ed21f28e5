#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/strain/peaks.hpp>

#include "support/heart_run.hpp"

namespace cardiac {
namespace {

constexpr std::array kInfarcted{1, 2, 7, 8, 13, 14};
constexpr std::array kRemote{4, 5, 10, 11, 15, 16};  // share no border with an infarcted segment, but 15, 16

const testing::HeartRun& infarct() {
  return testing::shipped_run("infarct_lv");
}

TEST(InfarctedVentricle, EjectsLessThanTheHealthyOne) {
  ASSERT_TRUE(infarct().path.completed) << infarct().path.stop_reason;
  const auto& healthy = testing::shipped_run("healthy_lv").result.ventricles[0];
  const auto& lv = infarct().result.ventricles[0];
  EXPECT_LE(lv.ef_percent, healthy.ef_percent - 8);
  EXPECT_GT(lv.ef_percent, 15);
  EXPECT_LT(lv.peak_pressure_mmHg, healthy.peak_pressure_mmHg);
  EXPECT_GT(infarct().result.min_det_F, 0.5);
}

TEST(InfarctedVentricle, InfarctedSegmentsDoNotShortenAndRemoteOnesDo) {
  const BeatResult& r = infarct().result;
  const auto& lv = r.ventricles[0];
  const auto peaks = strain_peaks(r.instants, lv.ed_time_ms, lv.es_time_ms);
  for (const int s : kInfarcted) {
    SCOPED_TRACE(aha_name(s));
    EXPECT_GT(peaks[s - 1].circumferential.systolic, -0.05);
    // The peak of a segment that shortens a little and lengthens a lot tells only the former: look at all.
    double highest = -1;
    for (const Instant& i : r.instants)
      if (i.time_ms >= lv.ed_time_ms && i.time_ms <= lv.es_time_ms)
        highest = std::max(highest, i.strain[s - 1].circumferential);
    EXPECT_GT(highest, 0.02);  // bulges under the pressure of the others
  }
  for (const int s : kRemote) {
    SCOPED_TRACE(aha_name(s));
    EXPECT_LT(peaks[s - 1].circumferential.systolic, -0.1);
    EXPECT_GT(peaks[s - 1].radial.systolic, 0.1);
  }
}

}  // namespace
}  // namespace cardiac
