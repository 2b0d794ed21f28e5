#include "polyaffine/core/parallel.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace polyaffine {
namespace {

int calls = 0;

void backwards(int begin, int end, void (*work)(int, const void*), const void* context) {
  ++calls;
  for (int k = end; k-- > begin;) work(k, context);
}

class Parallel : public testing::Test {
 protected:
  ~Parallel() override { set_parallel_backend(former_); }

 private:
  ParallelBackend former_ = parallel_backend();
};

std::vector<int> order(int begin, int end) {
  std::vector<int> out;
  parallel_for(begin, end, [&](int k) { out.push_back(k); });
  return out;
}

TEST_F(Parallel, RunsInOrderWithoutABackendAndAsTheBackendSays) {
  set_parallel_backend(nullptr);
  EXPECT_EQ(order(2, 6), (std::vector<int>{2, 3, 4, 5}));
  EXPECT_EQ(order(2, 2), std::vector<int>());
  calls = 0;
  set_parallel_backend(backwards);
  EXPECT_EQ(parallel_backend(), backwards);
  EXPECT_EQ(order(2, 6), (std::vector<int>{5, 4, 3, 2}));
  EXPECT_EQ(calls, 1);
}

TEST_F(Parallel, LetsWhatTheWorkThrowsThrough) {
  for (const ParallelBackend backend : {ParallelBackend(nullptr), ParallelBackend(backwards)}) {
    set_parallel_backend(backend);
    EXPECT_THROW(parallel_for(0, 3,
                              [](int k) {
                                if (k == 1) throw std::runtime_error("one");
                              }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace polyaffine
