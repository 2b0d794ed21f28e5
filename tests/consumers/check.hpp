#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

/// Ends the program with status 1 unless the value is within the tolerance of what is expected.
inline void check(const char* what, double value, double expected, double tolerance) {
  std::printf("%s: %.9g\n", what, value);
  if (std::abs(value - expected) <= tolerance) return;
  std::fprintf(stderr, "%s: %.17g instead of %.17g\n", what, value, expected);
  std::exit(1);
}
