#include <gtest/gtest.h>

#include "support/heart_run.hpp"

namespace cardiac {
namespace {

using testing::HeartRun;

/// A protocol that names nothing but a mesh: everything else is a default.
Protocol defaults_on(const std::string& mesh, const std::string& scheme) {
  return parse_protocol("[mesh]\nfile = \"" + mesh +
                            "\"\nlength_unit = \"mm\"\n[tissue]\n[fibres]\n[activation]\n[contraction]\n"
                            "[circulation]\n",
                        PROJECT_DIR "/meshes/defaults.toml", {"anatomy.scheme=" + scheme});
}

// Normal values of adults: EF, EDV and twist of cardiac magnetic resonance, peak pressures of catheters. The
// base does not move, so that the longitudinal strain falls short of the normal -18 %.
void expect_healthy_left(const BeatResult& r) {
  const VentricleSummary& lv = r.ventricles.at(0);
  EXPECT_GE(lv.ef_percent, 50);
  EXPECT_LE(lv.ef_percent, 70);
  EXPECT_GE(lv.edv_mL, 90);
  EXPECT_LE(lv.edv_mL, 150);
  EXPECT_GE(lv.peak_pressure_mmHg, 110);
  EXPECT_LE(lv.peak_pressure_mmHg, 130);
  EXPECT_GE(lv.edp_mmHg, 4);
  EXPECT_LE(lv.edp_mmHg, 12);
  EXPECT_GE(r.strain.twist_deg, 8);
  EXPECT_LE(r.strain.twist_deg, 20);
  EXPECT_GE(r.strain.gls_percent, -22);
  EXPECT_LE(r.strain.gls_percent, -13);
  EXPECT_GE(r.strain.gcs_percent, -24);
  EXPECT_LE(r.strain.gcs_percent, -15);
  EXPECT_GE(r.strain.grs_percent, 25);
  EXPECT_LE(r.strain.grs_percent, 60);
}

TEST(DefaultHeart, OneVentricleIsHealthy) {
  const HeartRun run(defaults_on("healthy_lv.vtu", "aha17"));
  ASSERT_TRUE(run.path.completed) << run.path.stop_reason;
  EXPECT_TRUE(run.protocol.warnings.empty());
  expect_healthy_left(run.result);
  EXPECT_GT(run.result.min_det_F, 0.5);
}

// The same defaults; of the right ventricle EF 45 to 65 %, peak pressure 20 to 32 mmHg.
TEST(DefaultHeart, TwoVentriclesAreHealthy) {
  const HeartRun run(defaults_on("healthy_biv_coarse.vtu", "aha29"));
  ASSERT_TRUE(run.path.completed) << run.path.stop_reason;
  expect_healthy_left(run.result);
  const VentricleSummary& rv = run.result.ventricles.at(1);
  EXPECT_GE(rv.ef_percent, 45);
  EXPECT_LE(rv.ef_percent, 65);
  EXPECT_GE(rv.peak_pressure_mmHg, 20);
  EXPECT_LE(rv.peak_pressure_mmHg, 32);
}

}  // namespace
}  // namespace cardiac
