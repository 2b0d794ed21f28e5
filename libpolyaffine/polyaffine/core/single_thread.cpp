#include "polyaffine/core/single_thread.hpp"

#include <tbb/global_control.h>

#include <ctime>

#include <polyaffine/core/serial_blas.hpp>

namespace polyaffine {

struct SingleThread::Limits {
  tbb::global_control parallelism{tbb::global_control::max_allowed_parallelism, 1};
  SerialBlas serial_blas;
};

SingleThread::SingleThread() : limits_(std::make_unique<Limits>()) {}

SingleThread::~SingleThread() = default;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace polyaffine
