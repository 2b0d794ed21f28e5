#include "polyaffine/core/single_thread.hpp"

#include <dlfcn.h>
#include <tbb/global_control.h>

#include <ctime>

namespace polyaffine {

struct SingleThread::Limits {
  using SetThreads = void (*)(int);
  using GetThreads = int (*)();

  tbb::global_control parallelism{tbb::global_control::max_allowed_parallelism, 1};
  SetThreads set_blas = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  GetThreads get_blas = reinterpret_cast<GetThreads>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  int blas_threads = get_blas ? get_blas() : 1;
};

SingleThread::SingleThread() : limits_(std::make_unique<Limits>()) {
  if (limits_->set_blas) limits_->set_blas(1);
}

SingleThread::~SingleThread() {
  if (limits_->set_blas) limits_->set_blas(limits_->blas_threads);
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace polyaffine
