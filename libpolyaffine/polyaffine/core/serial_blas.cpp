#include "polyaffine/core/serial_blas.hpp"

#include <omp.h>

// Of OpenBLAS; absent with another BLAS, which then keeps its own number of threads.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace polyaffine {
namespace {

bool set_blas_serial() {
  if (openblas_set_num_threads) openblas_set_num_threads(1);
  return true;
}

}  // namespace

// No active level at all: CHOLMOD names its number of threads itself, which a default would not change.
SerialBlas::SerialBlas() : active_levels_(omp_get_max_active_levels()) {
  [[maybe_unused]] static const bool once = set_blas_serial();
  omp_set_max_active_levels(0);
}

SerialBlas::~SerialBlas() {
  omp_set_max_active_levels(active_levels_);
}

}  // namespace polyaffine
