#pragma once

#include <string>

namespace cardiac::app {

/// While it lives SIGINT, SIGTERM and SIGHUP are only noted (a second one ends the program as usual); a
/// signal that is ignored stays so.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// "interrupted by SIGINT" once the signal came, empty before.
  std::string reason() const;
};

}  // namespace cardiac::app
