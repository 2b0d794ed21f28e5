#include <gtest/gtest.h>
#include <time.h>

#include <chrono>

#include <polyaffine/core/single_thread.hpp>

namespace polyaffine {
namespace {

TEST(ProcessorSeconds, CountWorkAndNotWaiting) {
  // Threads that libraries begin with the process spin for a while before they rest.
  const timespec pause{0, 50'000'000}, settle{0, 500'000'000};
  nanosleep(&settle, nullptr);
  const double start = processor_seconds();
  nanosleep(&pause, nullptr);
  const double waited = processor_seconds() - start;
  EXPECT_LT(waited, 0.02);
  volatile double sum = 0;
  const auto begin = std::chrono::steady_clock::now();
  while (processor_seconds() - start < waited + 0.05 &&
         std::chrono::steady_clock::now() - begin < std::chrono::seconds(20))
    for (int i = 0; i < 10000; ++i) sum = sum + i;
  EXPECT_GE(processor_seconds() - start, waited + 0.05);
}

}  // namespace
}  // namespace polyaffine
