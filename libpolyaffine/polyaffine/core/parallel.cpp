#include "polyaffine/core/parallel.hpp"

#include <atomic>

namespace polyaffine {
namespace {

std::atomic<ParallelBackend> current = nullptr;

}  // namespace

void set_parallel_backend(ParallelBackend backend) {
  current.store(backend);
}

ParallelBackend parallel_backend() {
  return current.load(std::memory_order_acquire);
}

}  // namespace polyaffine
