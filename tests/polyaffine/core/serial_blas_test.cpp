#include "polyaffine/core/serial_blas.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

extern "C" {
int omp_get_max_active_levels();
void omp_set_max_active_levels(int);
int openblas_get_num_threads() __attribute__((weak));
}

namespace polyaffine {
namespace {

TEST(SerialBlas, GivesTheLevelsOfOpenMPBack) {
  omp_set_max_active_levels(3);
  {
    const SerialBlas outer;
    const SerialBlas inner;
    EXPECT_EQ(omp_get_max_active_levels(), 0);
  }
  EXPECT_EQ(omp_get_max_active_levels(), 3);
}

// Each of two threads enters and leaves many times while the other does: inside there is never more than one
// thread, outside each has what it set.
TEST(SerialBlas, HoldsWhereSolvesRunSideBySide) {
  std::atomic<int> wrong = 0;
  const auto work = [&](int levels) {
    omp_set_max_active_levels(levels);
    for (int k = 0; k < 20000; ++k) {
      {
        const SerialBlas serial;
        wrong += omp_get_max_active_levels() != 0;
        if (openblas_get_num_threads) wrong += openblas_get_num_threads() != 1;
      }
      wrong += omp_get_max_active_levels() != levels;
    }
  };
  std::vector<std::thread> threads;
  for (const int levels : {1, 2}) threads.emplace_back(work, levels);
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace polyaffine
