#include <gtest/gtest.h>
#include <malloc.h>

#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/run/checkpoint.hpp>

#include "support/heart_run.hpp"

namespace cardiac {
namespace {

TEST(Memory, TwelveBeatsNeedNoMoreThanThree) {
  if (mallinfo2().uordblks == 0) GTEST_SKIP() << "this build's malloc keeps no count (sanitizers)";
  const Protocol protocol = testing::shipped_protocol(
      "healthy_lv", testing::on_land_ellipsoid(
                        {"time.max_beats=12", "time.limit_cycle_tolerance_percent=1e-12",
                         "circulation.compliance_mL_per_mmHg=5"}));  // beats that do not repeat before
  const Ventricle ventricle =
      build_ventricle(testing::read_anatomy(protocol), protocol, protocol.reduction.method);
  std::vector<double> in_use;  // before each beat, with the path of the one before
  in_use.reserve(12);
  RunControl control;
  control.on_checkpoint = [&](const Checkpoint&) {
    in_use.push_back(static_cast<double>(mallinfo2().uordblks));
  };
  const HeartPath path = run_beats(ventricle, protocol, control);
  ASSERT_EQ(in_use.size(), 12);
  const double state = static_cast<double>(sizeof(HeartState) + sizeof(double) * path.steps.front().c.size());
  // The steps of a beat may be some tens more than those of another; a vector lost in each would be 9 beats
  // of them, more than four hundred.
  const double growth = in_use.back() - in_use[2];
  std::cout << "heap before beat 3: " << in_use[2] / 1024 << " kB, before beat 12: " << in_use.back() / 1024
            << " kB; a state takes " << state / 1024 << " kB, a beat has " << path.steps.size()
            << " steps and " << path.outputs.size() << " outputs\n";
  EXPECT_GT(path.steps.size(), 50);
  EXPECT_LT(growth, 40 * state);
}

}  // namespace
}  // namespace cardiac
