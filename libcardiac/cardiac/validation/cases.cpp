#include <cardiac/validation/cube.hpp>
#include "cardiac/validation/check.hpp"

namespace cardiac {

const std::vector<ValidationCase>& validation_cases() {
  static const std::vector<ValidationCase> cases{
      {"cube", "the poly-affine paper's Table 1, and the cube between no-slip platens", validate_cube}};
  return cases;
}

}  // namespace cardiac
