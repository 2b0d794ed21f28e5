#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <map>

#include <cardiac/strain/peaks.hpp>

#include "support/heart_run.hpp"

// The numbers that the shipped protocols give, kept in pinned/NAME.csv, so that no change moves them unseen.
// Where a change means to move them: CARDIAC_UPDATE_PINS=1 build/release/bin/test_cardiac_run
// --gtest_filter='Pinned*' writes the files anew; the commit says why. Where none is meant, in a rewrite:
// CARDIAC_EXACT_PINS=1 holds the numbers to their nine digits, on the kind of machine that wrote them.
namespace cardiac {
namespace {

using Pins = std::map<std::string, double>;

// Relative change that is accepted: beyond what another compiler or processor makes of the tolerances of the
// time integration (1e-3 of the volumes' and pressures' scale), below what anyone reads off a table.
constexpr double kRelative = 1e-3;
// And in absolute terms for numbers near zero: strain, of order 0.1; percent and degrees, of order 10.
constexpr double kStrain = 1e-4, kPercent = 1e-2;

constexpr double kExact = 1e-8;

bool exact() {
  return std::getenv("CARDIAC_EXACT_PINS") != nullptr;
}

double floor_of(const std::string& name) {
  if (exact()) return 1e-9;  // the last of the tables' digits
  return name.starts_with("segment") ? kStrain : name.starts_with("strain") ? kPercent : 0;
}

Pins pins_of(const BeatResult& result) {
  Pins out;
  for (const VentricleSummary& v : result.ventricles) {
    out[v.name + ".peak_pressure_mmHg"] = v.peak_pressure_mmHg;
    if (!result.has_beat) {
      out[v.name + ".volume_mL"] = v.samples.back().volume_mL;
      continue;
    }
    out[v.name + ".edv_mL"] = v.edv_mL;
    out[v.name + ".esv_mL"] = v.esv_mL;
    out[v.name + ".ef_percent"] = v.ef_percent;
    out[v.name + ".edp_mmHg"] = v.edp_mmHg;
  }
  out["strain.gls_percent"] = result.strain.gls_percent;
  out["strain.gcs_percent"] = result.strain.gcs_percent;
  out["strain.grs_percent"] = result.strain.grs_percent;
  out["strain.twist_deg"] = result.strain.twist_deg;
  const VentricleSummary& lv = result.ventricles.front();
  const auto peaks = strain_peaks(result.instants, lv.ed_time_ms, lv.es_time_ms);
  for (std::size_t s = 0; s < peaks.size(); ++s) {
    const std::string segment = "segment_" + std::to_string(s + 1) + ".";
    out[segment + "longitudinal"] = peaks[s].longitudinal.value;
    out[segment + "circumferential"] = peaks[s].circumferential.value;
    out[segment + "radial"] = peaks[s].radial.value;
  }
  return out;
}

std::string file_of(const std::string& name) {
  return PROJECT_DIR "/tests/cardiac/run/pinned/" + name + ".csv";
}

void write(const std::string& name, const Pins& pins) {
  std::ofstream out(file_of(name));
  out << "quantity,value\n" << std::setprecision(9);
  for (const auto& [quantity, value] : pins) out << quantity << ',' << value << '\n';
  ASSERT_TRUE(out.flush()) << file_of(name);
}

Pins read(const std::string& name) {
  std::ifstream in(file_of(name));
  Pins out;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const auto comma = line.find(',');
    out[line.substr(0, comma)] = std::stod(line.substr(comma + 1));
  }
  return out;
}

void expect_pinned(const std::string& name, const BeatResult& result) {
  ASSERT_TRUE(result.completed) << result.stop_reason;
  const Pins now = pins_of(result);
  if (std::getenv("CARDIAC_UPDATE_PINS")) return write(name, now);
  const Pins pinned = read(name);
  ASSERT_EQ(pinned.size(), now.size()) << file_of(name);
  for (const auto& [quantity, value] : now) {
    ASSERT_TRUE(pinned.contains(quantity)) << quantity;
    const double expected = pinned.at(quantity);
    EXPECT_NEAR(value, expected,
                std::max((exact() ? kExact : kRelative) * std::abs(expected), floor_of(quantity)))
        << quantity;
  }
}

TEST(Pinned, HealthyLeftVentricle) {
  expect_pinned("healthy_lv", testing::shipped_run("healthy_lv").result);
}

TEST(Pinned, InfarctedLeftVentricle) {
  expect_pinned("infarct_lv", testing::shipped_run("infarct_lv").result);
}

TEST(Pinned, PassiveInflation) {
  expect_pinned("passive_inflation", testing::shipped_run("passive_inflation").result);
}

TEST(Pinned, HealthyBiventricleOnTheCoarseMesh) {
  const testing::HeartRun run(
      testing::shipped_protocol("healthy_biv", {"mesh.file=" PROJECT_DIR "/meshes/healthy_biv_coarse.vtu"}));
  expect_pinned("healthy_biv_coarse", run.result);
}

const std::string kCoarse = "mesh.file=" PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu";

TEST(Pinned, FullOrderInflationOnTheCoarseMesh) {
  const testing::HeartRun run(
      testing::shipped_protocol("passive_inflation", {kCoarse, "reduction.method=fem"}));
  expect_pinned("passive_inflation_full_order", run.result);
}

TEST(Pinned, FullOrderBeatOnTheCoarseMesh) {
  const testing::HeartRun run(testing::shipped_protocol(
      "healthy_lv", {kCoarse, "reduction.method=fem", "reduction.element_order=1", "time.max_beats=1"}));
  expect_pinned("healthy_lv_full_order", run.result);
}

}  // namespace
}  // namespace cardiac
