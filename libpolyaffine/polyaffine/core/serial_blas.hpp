#pragma once

namespace polyaffine {

/// While it lives, OpenMP regions of the calling thread and OpenBLAS run on that thread alone. The fronts of
/// a supernodal factorisation are small: threads that share them spend more time waiting for each other,
/// awake, than they save, and their sums depend on their number.
///
/// Safe where solves run side by side: the limit of OpenMP belongs to the calling thread, which gets its own
/// back at the end, and the number of threads of OpenBLAS, which has only one for the process, becomes 1 at
/// the first use and stays so.
class SerialBlas {
 public:
  SerialBlas();
  ~SerialBlas();
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;

 private:
  int active_levels_;
};

}  // namespace polyaffine
