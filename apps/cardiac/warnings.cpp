#include "warnings.hpp"

#include <iostream>

namespace cardiac::app {

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::cerr << "cardiac: warning: " << warning << '\n';
}

}  // namespace cardiac::app
