#include "polyaffine/core/threads.hpp"

#include <tbb/parallel_for.h>

#include <polyaffine/core/parallel.hpp>

namespace polyaffine {

void use_threads() {
  if (parallel_backend()) return;
  set_parallel_backend([](int begin, int end, void (*work)(int, const void*), const void* context) {
    tbb::parallel_for(begin, end, [=](int k) { work(k, context); });
  });
}

}  // namespace polyaffine
