#pragma once

namespace polyaffine {

/// While it lives, OpenMP regions and OpenBLAS run on the calling thread alone. The fronts of a supernodal
/// factorisation are small: threads that share them spend more time waiting for each other, awake, than they
/// save, and their sums depend on their number.
class SerialBlas {
 public:
  SerialBlas();
  ~SerialBlas();
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;

 private:
  int active_levels_, blas_threads_;
};

}  // namespace polyaffine
