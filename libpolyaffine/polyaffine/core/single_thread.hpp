#pragma once

#include <memory>

namespace polyaffine {

/// While it lives, parallel loops (TBB), OpenMP and OpenBLAS use one thread: for times that can be compared.
/// TBB keeps the lowest limit that lives, so that several may.
class SingleThread {
 public:
  SingleThread();
  ~SingleThread();
  SingleThread(const SingleThread&) = delete;
  SingleThread& operator=(const SingleThread&) = delete;

 private:
  struct Limits;
  std::unique_ptr<Limits> limits_;
};

/// Processor time used so far by all threads of this process, s: on one thread the time that work takes,
/// whatever else the machine does.
double processor_seconds();

}  // namespace polyaffine
