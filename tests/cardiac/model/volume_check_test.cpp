#include "cardiac/model/volume_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <polyaffine/core/error.hpp>

#include "support/heart_run.hpp"

namespace cardiac {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

VolumeCheck check(const std::string& name, std::vector<std::string> overrides) {
  const Protocol protocol = testing::shipped_protocol(name, overrides);
  return check_volume(testing::read_anatomy(protocol), protocol);
}
VolumeCheck on_land(std::vector<std::string> overrides) {
  return check("passive_inflation", testing::on_land_ellipsoid(std::move(overrides)));
}

VolumeCheck two_ventricles(const std::string& preset) {
  return check("healthy_biv", {preset, "mesh.file=\"" PROJECT_DIR "/meshes/healthy_biv_coarse.vtu\""});
}

TEST(VolumeCheck, PassesBothPresetsOnOneVentricleAndOnTwo) {
  for (const std::string preset : {"reduction.preset=fast", "reduction.preset=accurate"}) {
    const std::vector<VolumeCheck> checks{on_land({preset}), check("passive_inflation", {preset}),
                                          check("healthy_lv", {preset}), two_ventricles(preset)};
    for (const VolumeCheck& found : checks) {
      EXPECT_THAT(found.warnings, IsEmpty()) << preset;
      ASSERT_TRUE(found.inf_sup);
      EXPECT_GT(found.inf_sup->beta(), 1.5 * kUnstableInfSup);  // measured: 0.836 to 0.965
      EXPECT_GT(found.compliance_ratio, 0.85);                  // 0.889 to 0.966
      EXPECT_LT(found.compliance_ratio, 1);
      EXPECT_GT(found.displacements, 3 * found.inf_sup->pressures);
    }
  }
}

TEST(VolumeCheck, WarnsOfAffineFramesWithEveryPoint) {
  const VolumeCheck found = on_land({"reduction.enrichment=[]", "reduction.pressure_space=none"});
  EXPECT_FALSE(found.inf_sup);
  EXPECT_LT(found.compliance_ratio, 0.1);
  EXPECT_THAT(found.warnings, ElementsAre(HasSubstr("locking")));
}

TEST(VolumeCheck, WarnsOfPressuresThroughTheDepthOfAffineFrames) {
  const VolumeCheck found = on_land({"reduction.enrichment=[]", "reduction.pressure_space=segment_depth"});
  EXPECT_THAT(found.warnings, ElementsAre(HasSubstr("locking"), HasSubstr("unstable")));
}

TEST(VolumeCheck, AcceptsOnePressureOfEachAffineFrame) {
  EXPECT_THAT(on_land({"reduction.enrichment=[]", "reduction.pressure_space=segment"}).warnings, IsEmpty());
}

TEST(VolumeCheck, WarnsOfMorePressuresThanTheFunctionsControl) {
  const VolumeCheck found = on_land({"reduction.preset=fast", "reduction.pressure_space=segment_bilinear"});
  EXPECT_THAT(found.warnings, ElementsAre(HasSubstr("unstable")));
  ASSERT_TRUE(found.inf_sup);
  EXPECT_LT(found.inf_sup->beta(), 0.15);
}

TEST(VolumeCheck, IsOfReducedModels) {
  EXPECT_THROW(on_land({"reduction.method=fem"}), polyaffine::InputError);
}

}  // namespace
}  // namespace cardiac
