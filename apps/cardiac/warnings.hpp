#pragma once

#include <string>
#include <vector>

namespace cardiac::app {

/// Each text as a warning, a line of its own, on the standard error; no option hides it.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace cardiac::app
