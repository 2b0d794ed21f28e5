#include "progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace cardiac::app {

ProgressLine::ProgressLine(bool quiet, const char* bound)
    : bound_(bound), active_(!quiet && isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::operator()(const std::string& what, double fraction) {
  const std::scoped_lock lock(mutex_);
  const auto now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  if (!active_ || elapsed < 2 || std::chrono::duration<double>(now - last_).count() < 0.2) return;
  last_ = now;
  shown_ = true;
  std::fprintf(stderr, "\r\033[K%s  %3.0f %%  %.0f s", what.c_str(), 100 * fraction, elapsed);
  if (fraction > 0) std::fprintf(stderr, ", %s %.0f s left", bound_, elapsed * (1 - fraction) / fraction);
  std::fflush(stderr);
}

}  // namespace cardiac::app
