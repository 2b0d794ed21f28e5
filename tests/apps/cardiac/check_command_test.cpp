#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

ProgramRun check(const std::string& more) {
  return run_program("check " PROJECT_DIR
                     "/protocols/passive_inflation.toml "
                     "--set 'mesh.file=\"" PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu\"' " +
                     more);
}

TEST(CheckCommand, PrintsCountsAndTheInfSupConstantOfAPreset) {
  const ProgramRun found = check("");
  EXPECT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.err, IsEmpty());
  EXPECT_THAT(found.out, HasSubstr("pressure unknowns       65"));
  EXPECT_THAT(found.out, HasSubstr("smallest singular values 0.8"));
  EXPECT_THAT(found.out, HasSubstr("compliance ratio        0.9"));
}

TEST(CheckCommand, FailsWithAWarningWhereTheModelLocks) {
  const ProgramRun found = check("--set 'reduction.enrichment=[]' --set reduction.pressure_space=none");
  EXPECT_EQ(found.status, 1);
  EXPECT_THAT(found.err, HasSubstr("locking"));
  EXPECT_THAT(found.out, HasSubstr("every integration point"));
}

TEST(CheckCommand, RefusesFullOrder) {
  const ProgramRun found = check("--set reduction.method=fem");
  EXPECT_EQ(found.status, 2);
  EXPECT_THAT(found.err, HasSubstr("reduction.method"));
}

}  // namespace
