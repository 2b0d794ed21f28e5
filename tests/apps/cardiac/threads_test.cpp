#include <gtest/gtest.h>
#include <sched.h>

#include "program.hpp"

namespace {

/// Lets this process and its children run on the first processors only.
class OnProcessors {
 public:
  explicit OnProcessors(int count) {
    sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t few;
    CPU_ZERO(&few);
    for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&few) < count; ++cpu)
      if (CPU_ISSET(cpu, &before_)) CPU_SET(cpu, &few);
    sched_setaffinity(0, sizeof few, &few);
  }
  ~OnProcessors() { sched_setaffinity(0, sizeof before_, &before_); }
  OnProcessors(const OnProcessors&) = delete;
  OnProcessors& operator=(const OnProcessors&) = delete;

 private:
  cpu_set_t before_{};
};

class Threads : public testing::TestWithParam<const char*> {};

TEST_P(Threads, OneOrTwoGiveTheSameBits) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& name) {
    const ProgramRun done = run_program("run " PROJECT_DIR "/protocols/" + std::string(GetParam()) +
                                        " --quiet --out " + (folder.path / name).string() +
                                        " --set 'mesh.file=\"" PROJECT_DIR
                                        "/meshes/land_ellipsoid_coarse.vtu\"'"
                                        " --set output.figures=false");
    EXPECT_EQ(done.status, 0) << done.err;
  };
  setenv("OPENBLAS_NUM_THREADS", "2", 1);
  run("two");
  setenv("OPENBLAS_NUM_THREADS", "1", 1);
  {
    const OnProcessors one(1);
    run("one");
  }
  unsetenv("OPENBLAS_NUM_THREADS");
  for (const char* table :
       {"strain.csv", "strain_peaks.csv", "affine.csv", "global_strain.csv", "cavity.csv"}) {
    const std::string text = whole_file(folder.path / "one" / table);
    EXPECT_GT(text.size(), 100) << table;
    EXPECT_EQ(text, whole_file(folder.path / "two" / table)) << table;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Protocols, Threads,
    testing::Values("healthy_lv.toml --set time.max_beats=1",
                    "healthy_lv.toml --set time.max_beats=1 --set reduction.preset=accurate",
                    "passive_inflation.toml --method fem"));

}  // namespace
