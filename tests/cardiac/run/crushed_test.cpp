#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/heart_run.hpp"

namespace cardiac {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// One beat of a wall whose fibres all run around it, which crushes it where volumes are free locally.
BeatResult around(std::vector<std::string> overrides) {
  overrides.insert(overrides.end(),
                   {"fibres.endo_angle_deg=0", "fibres.epi_angle_deg=0", "time.max_beats=1"});
  return testing::HeartRun(testing::shipped_protocol("healthy_lv", testing::on_land_ellipsoid(overrides)))
      .result;
}

TEST(Crushed, TheDefaultKeepsLocalVolumesAndTheAdviceNamesTheKeyThatDoes) {
  const BeatResult result = around({}),
                   free = around({"reduction.local_bulk_modulus_kPa=1", "reduction.pressure_space=segment"});
  const auto advice = HasSubstr("raise reduction.local_bulk_modulus_kPa");
  EXPECT_GT(result.min_det_F, 0.5);
  EXPECT_THAT(result.warnings, Not(Contains(advice)));
  EXPECT_LT(free.min_det_F, 0.5);
  EXPECT_THAT(free.warnings, Contains(advice));
}

}  // namespace
}  // namespace cardiac
