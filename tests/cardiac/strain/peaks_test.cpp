#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <cardiac/strain/peaks.hpp>

namespace cardiac {
namespace {

/// One segment, the same strain in all three directions, sampled every ms over [0, 800].
template <class Curve>
std::vector<Instant> beat_of(Curve curve, double step = 1) {
  std::vector<Instant> instants;
  for (double t = 0; t <= 800; t += step) {
    const double e = curve(t);
    Instant& instant = instants.emplace_back();
    instant.time_ms = t;
    instant.strain = {{e, e, e, 0, 0, 0, 1}};
  }
  return instants;
}

double half_wave(double t, double from, double to) {
  return t < from || t > to ? 0 : std::sin(polyaffine::kPi * (t - from) / (to - from));
}

TEST(StrainPeaks, OfAShorteningCurveAreItsMinimumAndWhatFollowsEndSystole) {
  // −0.2 sin(πt/800): least at 400, at ES (300) −0.2 sin(3π/8).
  const auto peaks = strain_peaks(beat_of([](double t) { return -0.2 * half_wave(t, 0, 800); }), 0, 300);
  ASSERT_EQ(peaks.size(), 1);
  const double es = -0.2 * std::sin(3 * polyaffine::kPi / 8);
  for (const StrainPeak& p : {peaks[0].longitudinal, peaks[0].circumferential}) {
    EXPECT_DOUBLE_EQ(p.value, -0.2);
    EXPECT_DOUBLE_EQ(p.time_ms, 400);
    EXPECT_NEAR(p.end_systolic, es, 1e-15);
    EXPECT_NEAR(p.systolic, es, 1e-15);
    EXPECT_NEAR(p.post_systolic_index_percent, 100 * (-0.2 - es) / -0.2, 1e-12);
  }
}

TEST(StrainPeaks, RadialPeakIsThickeningNotTheLargerThinning) {
  const auto curve = [](double t) { return 0.1 * half_wave(t, 100, 500) - 0.3 * half_wave(t, 500, 800); };
  const auto peaks = strain_peaks(beat_of(curve), 0, 350);
  EXPECT_DOUBLE_EQ(peaks[0].radial.value, 0.1);
  EXPECT_DOUBLE_EQ(peaks[0].radial.time_ms, 300);
  EXPECT_DOUBLE_EQ(peaks[0].longitudinal.value, -0.3);
  EXPECT_DOUBLE_EQ(peaks[0].longitudinal.time_ms, 650);
}

TEST(StrainPeaks, SegmentThatOnlyLengthensHasAPositivePeakAndNoPostSystolicIndex) {
  // 0.0005 of shortening late in the beat is below the resolution of 0.001.
  const auto curve = [](double t) { return 0.08 * half_wave(t, 0, 700) - 0.0005 * half_wave(t, 700, 800); };
  const StrainPeak p = strain_peaks(beat_of(curve), 0, 300)[0].longitudinal;
  EXPECT_DOUBLE_EQ(p.value, 0.08);
  EXPECT_DOUBLE_EQ(p.time_ms, 350);
  EXPECT_GT(p.systolic, 0);
  EXPECT_EQ(p.post_systolic_index_percent, 0);
}

TEST(StrainPeaks, PeakWithinSystoleHasNoPostSystolicIndex) {
  const StrainPeak p =
      strain_peaks(beat_of([](double t) { return -0.2 * half_wave(t, 0, 400); }), 0, 300)[0].longitudinal;
  EXPECT_DOUBLE_EQ(p.time_ms, 200);
  EXPECT_DOUBLE_EQ(p.systolic, p.value);
  EXPECT_EQ(p.post_systolic_index_percent, 0);
}

TEST(StrainPeaks, StretchAtEndSystoleBeforeLateShorteningHasNoIndex) {
  const auto curve = [](double t) { return 0.05 * half_wave(t, 200, 400) - 0.1 * half_wave(t, 400, 800); };
  const StrainPeak p = strain_peaks(beat_of(curve), 0, 300)[0].longitudinal;
  EXPECT_DOUBLE_EQ(p.end_systolic, 0.05);
  EXPECT_DOUBLE_EQ(p.systolic, 0.05);
  EXPECT_TRUE(std::isnan(p.post_systolic_index_percent));  // the quotient would be 150 %
}

TEST(StrainPeaks, NoIndexAfterAlmostNoStrainAtEndSystole) {
  // The same late shortening by 0.1 after 0.8 of the least strain at ES, and after 1.2 of it.
  const auto curve = [](double share) {
    return [share](double t) {
      return -share * kLeastEndSystolicStrain * half_wave(t, 200, 400) - 0.1 * half_wave(t, 400, 800);
    };
  };
  const StrainPeak still = strain_peaks(beat_of(curve(0.8)), 0, 300)[0].longitudinal;
  EXPECT_NEAR(still.end_systolic, -0.008, 1e-15);
  EXPECT_TRUE(std::isnan(still.post_systolic_index_percent));
  const StrainPeak moves = strain_peaks(beat_of(curve(1.2)), 0, 300)[0].longitudinal;
  EXPECT_NEAR(moves.post_systolic_index_percent, 88, 1e-12);
}

TEST(StrainPeaks, SystolicShorteningBeforeStretchAtEndSystoleHasNoIndex) {
  const auto curve = [](double t) { return -0.02 * half_wave(t, 0, 100) + 0.05 * half_wave(t, 100, 500); };
  const StrainPeak p = strain_peaks(beat_of(curve), 0, 300)[0].longitudinal;
  EXPECT_DOUBLE_EQ(p.time_ms, 50);
  EXPECT_DOUBLE_EQ(p.end_systolic, 0.05);
  EXPECT_TRUE(std::isnan(p.post_systolic_index_percent));
}

TEST(StrainPeaks, SystoleMayRunOverTheEndOfTheBeat) {
  // ED at 600, ES at 100: a peak at 0 is systolic, one at 400 is not.
  const auto early = [](double t) { return -0.2 * (t < 100 ? 1 - t / 100 : 0); };
  EXPECT_EQ(strain_peaks(beat_of(early), 600, 100)[0].longitudinal.post_systolic_index_percent, 0);
  const auto late = [](double t) { return -0.2 * half_wave(t, 300, 500) - 0.05 * half_wave(t, 0, 200); };
  EXPECT_DOUBLE_EQ(strain_peaks(beat_of(late), 600, 100)[0].longitudinal.post_systolic_index_percent, 75);
}

TEST(StrainPeaks, EndSystoleIsInterpolatedBetweenOutputTimes) {
  const StrainPeak p =
      strain_peaks(beat_of([](double t) { return -1e-3 * t; }, 50), 0, 312.5)[0].longitudinal;
  EXPECT_NEAR(p.end_systolic, -0.3125, 1e-15);
  EXPECT_NEAR(p.systolic, -0.3125, 1e-15);
}

TEST(StrainPeaks, AreDefinedForASegmentThatDoesNotMove) {
  const StrainPeak p = strain_peaks(beat_of([](double) { return 0.0; }), 0, 300)[0].radial;
  EXPECT_EQ(p.value, 0);
  EXPECT_EQ(p.time_ms, 0);
  EXPECT_EQ(p.post_systolic_index_percent, 0);
}

TEST(StrainPeaks, SkipWhatIsNotFinite) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto gap = [none](double t) { return t > 200 && t < 250 ? none : -0.2 * half_wave(t, 0, 800); };
  EXPECT_DOUBLE_EQ(strain_peaks(beat_of(gap), 0, 300)[0].longitudinal.value, -0.2);
  const StrainPeak p = strain_peaks(beat_of([none](double) { return none; }), 0, 300)[0].longitudinal;
  EXPECT_TRUE(std::isnan(p.value) && std::isnan(p.post_systolic_index_percent) && std::isnan(p.systolic));
  EXPECT_TRUE(strain_peaks({}, 0, 300).empty());
}

}  // namespace
}  // namespace cardiac
