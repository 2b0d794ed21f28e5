#include "interrupt.hpp"

#include <array>
#include <csignal>
#include <string>

namespace cardiac::app {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t noted = 0;

void handle(void (*handler)(int), int flags) {
  for (const int number : kSignals) {
    struct sigaction old {};
    sigaction(number, nullptr, &old);
    if (old.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = flags;
    sigaction(number, &action, nullptr);
  }
}

}  // namespace

InterruptGuard::InterruptGuard() {
  handle([](int number) { noted = number; }, static_cast<int>(SA_RESETHAND));
}

InterruptGuard::~InterruptGuard() {
  handle(SIG_DFL, 0);
}

std::string InterruptGuard::reason() const {
  if (noted == 0) return "";
  return std::string("interrupted by ") + (noted == SIGINT    ? "SIGINT"
                                           : noted == SIGTERM ? "SIGTERM"
                                                              : "SIGHUP");
}

}  // namespace cardiac::app
