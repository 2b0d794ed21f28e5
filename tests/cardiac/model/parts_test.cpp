#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include <cardiac/protocol/plan.hpp>
#include <cardiac/run/build_ventricle.hpp>

#include "support/heart_run.hpp"

namespace cardiac {
namespace {

/// Parts of the plan that a builder makes after the anatomy.
constexpr std::array kBuilt{"fibres",      "activation", "contraction", "cavity",
                            "circulation", "regions",    "reduction",   "full order"};

BuildCount counted(const Ventricle& ventricle, const HeartPath& path) {
  BuildCount all = ventricle.built;
  for (const auto& [part, n] : path.built) all[part] += n;
  return all;
}

void expect_agreement(const Protocol& protocol, const BuildCount& built) {
  const auto items = plan(protocol);
  for (const std::string part : kBuilt) {
    const auto found = built.find(part);
    if (builds(items, part)) {
      EXPECT_TRUE(found != built.end() && found->second == 1) << part;
    } else {
      EXPECT_EQ(found, built.end()) << part;
    }
  }
  for (const auto& [part, n] : built) EXPECT_TRUE(builds(items, part)) << part;
}

TEST(Parts, PlanAndBuildersAgreeForEveryShippedProtocol) {
  int protocols = 0;
  for (const auto& file : std::filesystem::directory_iterator(PROJECT_DIR "/protocols")) {
    if (file.path().extension() != ".toml") continue;
    SCOPED_TRACE(file.path().filename().string());
    const Protocol protocol = testing::shipped_protocol(file.path().stem().string(), {"time.max_beats=1"});
    // Idealised shapes are meshed by the program; what they are built of is that of the healthy ventricle.
    if (protocol.mesh.shape) continue;
    const testing::HeartRun run(protocol);
    expect_agreement(run.protocol, counted(run.ventricle, run.path));
    ++protocols;
  }
  EXPECT_GE(protocols, 10);
}

TEST(Parts, PassiveInflationBuildsNothingOfABeat) {
  const auto& run = testing::shipped_run("passive_inflation");
  const BuildCount built = counted(run.ventricle, run.path);
  EXPECT_EQ(built, (BuildCount{{"reduction", 1}, {"cavity", 1}}));
  const auto items = plan(run.protocol);
  for (const char* part : {"fibres", "activation", "contraction", "circulation", "regions"}) {
    EXPECT_FALSE(built.contains(part)) << part;
    EXPECT_FALSE(builds(items, part)) << part;
  }
  EXPECT_EQ(run.ventricle.contraction, nullptr);
  EXPECT_TRUE(run.ventricle.supports.empty());
}

TEST(Parts, HealthyVentricleBuildsEachPartOnce) {
  const auto& run = testing::shipped_run("healthy_lv");
  EXPECT_EQ(counted(run.ventricle, run.path), (BuildCount{{"fibres", 1},
                                                          {"activation", 1},
                                                          {"contraction", 1},
                                                          {"cavity", 1},
                                                          {"circulation", 1},
                                                          {"reduction", 1}}));
}

TEST(Parts, FullOrderHasNoFrames) {
  const Protocol protocol = testing::shipped_protocol(
      "passive_inflation", testing::on_land_ellipsoid({"reduction.method=fem", "reduction.element_order=1"}));
  const Ventricle ventricle =
      build_ventricle(testing::read_anatomy(protocol), protocol, protocol.reduction.method);
  EXPECT_EQ(ventricle.built, (BuildCount{{"full order", 1}, {"cavity", 1}}));
  expect_agreement(protocol, ventricle.built);
  EXPECT_EQ(ventricle.discretisation.frame_basis, nullptr);
}

TEST(Parts, WallWithoutPressureHasNoCavity) {
  const Protocol protocol = parse_protocol(R"(
mesh = {file = "../meshes/land_ellipsoid_coarse.vtu", length_unit = "mm"}
fibres = {}
activation = {}
contraction = {}
)",
                                           PROJECT_DIR "/protocols/unloaded.toml");
  const Ventricle ventricle =
      build_ventricle(testing::read_anatomy(protocol), protocol, protocol.reduction.method);
  EXPECT_EQ(ventricle.built,
            (BuildCount{{"fibres", 1}, {"activation", 1}, {"contraction", 1}, {"reduction", 1}}));
  expect_agreement(protocol, ventricle.built);
  EXPECT_TRUE(ventricle.cavities.empty());
}

}  // namespace
}  // namespace cardiac
