#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace cardiac::app {

/// One line on stderr that shows what runs, how far it is and when it will be done; only on a terminal, only
/// after two seconds, and cleared at the end. Any thread may call it.
class ProgressLine {
 public:
  /// `bound` says what the time left is: "at most" where the work may end before its last part, "about".
  explicit ProgressLine(bool quiet, const char* bound = "at most");
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  void operator()(const std::string& what, double fraction);

 private:
  using Clock = std::chrono::steady_clock;
  std::mutex mutex_;
  const char* bound_;
  bool shown_ = false, active_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace cardiac::app
