#include "polyaffine/core/threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include <polyaffine/core/parallel.hpp>

namespace polyaffine {
namespace {

void alone(int begin, int end, void (*work)(int, const void*), const void* context) {
  for (int k = begin; k < end; ++k) work(k, context);
}

class Threads : public testing::Test {
 protected:
  Threads() { set_parallel_backend(nullptr); }
  ~Threads() override { set_parallel_backend(nullptr); }
};

TEST_F(Threads, CallOnceForEachNumber) {
  use_threads();
  ASSERT_NE(parallel_backend(), nullptr);
  std::vector<std::atomic<int>> count(1000);
  parallel_for(0, 1000, [&](int k) { ++count[static_cast<std::size_t>(k)]; });
  for (const auto& n : count) EXPECT_EQ(n, 1);
}

TEST_F(Threads, LetWhatTheWorkThrowsThrough) {
  use_threads();
  EXPECT_THROW(parallel_for(0, 100,
                            [](int k) {
                              if (k == 50) throw std::runtime_error("fifty");
                            }),
               std::runtime_error);
}

TEST_F(Threads, LeaveABackendThatIsThere) {
  set_parallel_backend(alone);
  use_threads();
  EXPECT_EQ(parallel_backend(), alone);
}

}  // namespace
}  // namespace polyaffine
