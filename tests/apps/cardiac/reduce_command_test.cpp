#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "program.hpp"
#include "support/temporary_folder.hpp"

namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A passive wall on a coarse mesh: some seconds of learning.
const std::string kHeart =
    "\"" PROJECT_DIR "/protocols/passive_inflation.toml\" --set 'mesh.file=\"" PROJECT_DIR
    "/meshes/land_ellipsoid_coarse.vtu\"' ";

TEST(ReduceCommand, WritesAModelThatRunsAlone) {
  const TemporaryFolder folder;
  setenv("XDG_CACHE_HOME", folder.path.c_str(), 1);
  const std::string model = (folder.path / "heart.model").string();
  const ProgramRun learned = run_program("reduce " + kHeart + "--accuracy 5 --budget 20 --out " + model);
  EXPECT_EQ(learned.status, 0) << learned.err;
  EXPECT_THAT(learned.out, HasSubstr("full-order solves"));
  const ProgramRun again = run_program("reduce " + kHeart + "--accuracy 5 --budget 20 --out " + model);
  EXPECT_EQ(again.status, 0) << again.err;  // of the cache

  const auto out = folder.path / "out";
  const ProgramRun run = run_program("run --model " + model + " --verify --out " + out.string());
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("against full order at ES: displacement "));
  EXPECT_TRUE(std::filesystem::exists(out / "strain.csv"));

  const ProgramRun other =
      run_program("run --model " + model + " --set tissue.law=mooney_rivlin --out " + out.string());
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("learned for"));
  for (const std::string key : {"'anatomy.anterior_direction=[1,0,0]'", "reduction.preset=fast"})
    EXPECT_EQ(run_program("run --model " + model + " --set " + key + " --out " + out.string()).status, 2)
        << key;
}

TEST(ReduceCommand, RefusesWrongInput) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_program("reduce " + kHeart).status, 2);  // no --out
  EXPECT_EQ(run_program("reduce " + kHeart + "--accuracy 0 --out " + (folder.path / "m").string()).status, 2);
  const ProgramRun both = run_program("run " + kHeart + "--model nowhere.model");
  EXPECT_EQ(both.status, 2);
  EXPECT_THAT(both.err, HasSubstr("expected one of them"));
  const ProgramRun none = run_program("run --model nowhere.model");
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("nowhere.model"));
}

}  // namespace
