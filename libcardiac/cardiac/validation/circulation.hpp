#pragma once

#include <cardiac/validation/check.hpp>

namespace cardiac {

/// The circulation without a wall against published numbers: the two-element windkessel under a periodic
/// volume (trapezoidal rule), and the closed loop of Regazzoni et al. 2022, whose ten beats return to the
/// published limit cycle and keep the blood.
std::vector<Check> validate_circulation(const ValidationContext& context);

}  // namespace cardiac
