#pragma once

#include <cardiac/validation/check.hpp>

namespace cardiac {

/// Two ventricles of the idealised human heart, reduced (fast, accurate, heart axes) against quadratic
/// elements on the same mesh: filled (10 and 5 mmHg) and contracted (60 kPa along the fibres against 100 and
/// 25 mmHg), displacement and both cavities. And beats in the closed loop: what both
/// sides eject, the blood that is kept, and, unless quick, the first beat in full order.
std::vector<Check> validate_biventricle(const ValidationContext& context);

}  // namespace cardiac
