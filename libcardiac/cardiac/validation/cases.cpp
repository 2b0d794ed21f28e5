#include "cardiac/validation/check.hpp"

namespace cardiac {

const std::vector<ValidationCase>& validation_cases() {
  static const std::vector<ValidationCase> cases{};
  return cases;
}

}  // namespace cardiac
