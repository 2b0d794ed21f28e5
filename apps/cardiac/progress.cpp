#include "progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace cardiac::app {

ProgressLine::ProgressLine(bool quiet) : active_(!quiet && isatty(STDERR_FILENO) == 1) {}

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
  const double left = fraction > 0 ? elapsed * (1 - fraction) / fraction : 0;
  std::fprintf(stderr, "\r\033[K%s  %3.0f %%  %.0f s, at most %.0f s left", what.c_str(), 100 * fraction,
               elapsed, left);
  std::fflush(stderr);
}

}  // namespace cardiac::app
