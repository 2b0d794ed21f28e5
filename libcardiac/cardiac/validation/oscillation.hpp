#pragma once

#include <polyaffine/core/types.hpp>

namespace cardiac {

/// Amplitude √(A² + B²) of a wave in a profile, from the least-squares fit
///   y(s) ≈ Σ_{k ≤ degree} c_k P_k(s) + A cos(2πs/λ) + B sin(2πs/λ)
/// with Legendre polynomials over the range of s: what oscillates with the wavelength λ beside a smooth
/// trend. s and λ in one unit; the result in that of y. Throws std::invalid_argument when the sizes differ,
/// the wavelength is not positive, or there are fewer points than coefficients.
double oscillation(const polyaffine::Vector& s, const polyaffine::Vector& y, double wavelength, int degree);

}  // namespace cardiac
