#include "polyaffine/core/serial_blas.hpp"

#include <omp.h>

// Of OpenBLAS; absent with another BLAS, which then keeps its own number of threads.
extern "C" {
int openblas_get_num_threads() __attribute__((weak));
void openblas_set_num_threads(int) __attribute__((weak));
}

namespace polyaffine {

// No active level at all: CHOLMOD names its number of threads itself, which a default would not change.
SerialBlas::SerialBlas()
    : active_levels_(omp_get_max_active_levels()),
      blas_threads_(openblas_get_num_threads ? openblas_get_num_threads() : 1) {
  omp_set_max_active_levels(0);
  if (openblas_set_num_threads) openblas_set_num_threads(1);
}

SerialBlas::~SerialBlas() {
  omp_set_max_active_levels(active_levels_);
  if (openblas_set_num_threads) openblas_set_num_threads(blas_threads_);
}

}  // namespace polyaffine
