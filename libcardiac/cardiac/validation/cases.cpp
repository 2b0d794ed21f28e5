#include <cardiac/validation/biventricle.hpp>
#include <cardiac/validation/circulation.hpp>
#include <cardiac/validation/cube.hpp>
#include <cardiac/validation/elastodynamics.hpp>
#include <cardiac/validation/ellipsoid.hpp>
#include <cardiac/validation/extreme.hpp>
#include <cardiac/validation/land.hpp>
#include <cardiac/validation/tuned.hpp>

#include "cardiac/validation/check.hpp"

namespace cardiac {

const std::vector<ValidationCase>& validation_cases() {
  static const std::vector<ValidationCase> cases{
      {"land", "cardiac mechanics verification of Land et al. 2015, full order and reduced", validate_land},
      {"cube", "the poly-affine paper's Table 1, and the cube between no-slip platens", validate_cube},
      {"ellipsoid", "the poly-affine paper's truncated ellipsoid, zones against full order",
       validate_ellipsoid},
      {"circulation", "windkessel and closed loop without a wall, published numbers", validate_circulation},
      {"biventricle", "two ventricles, reduced against full order, and a beat in the closed loop",
       validate_biventricle},
      {"elastodynamics",
       "the benchmark of Aróstica et al. 2025 with inertia, pericardium and a moving base, full order and "
       "reduced",
       validate_elastodynamics},
      {"tuned", "a tuned model under 30 other protocols: its errors, and those that it tells of itself",
       validate_tuned},
      {"extreme", "stiff and extreme scenes, reduced and full order: within bounds or stopped with a reason",
       validate_extreme}};
  return cases;
}

}  // namespace cardiac
