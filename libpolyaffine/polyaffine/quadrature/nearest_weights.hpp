#pragma once

#include <polyaffine/core/types.hpp>
#include <polyaffine/quadrature/weight_conditions.hpp>

namespace polyaffine {

struct NearestWeightsOptions {
  double least = 0;          ///< every weight stays at least this fraction (0 ≤ least < 1) of what it was
  double dependent = 1e-10;  ///< conditions that follow from the others to this (relative) are left out
  double tolerance = 1e-13;  ///< on each condition, relative to its scale
  int max_iterations = 60;
};

struct NearestWeights {
  Vector weights;    ///< those that come closest to the conditions where none meets them
  double miss = 0;   ///< largest violation of a condition, relative to its scale
  bool met = false;  ///< miss within the tolerance
  int iterations = 0;
};

/// The weights nearest to w⁰ > 0 that meet the conditions: min Σ_q (w_q − w⁰_q)²/w⁰_q subject to A w = b and
/// w ≥ least·w⁰. The dual problem, w_q = max(w⁰_q (1 + (Aᵀλ)_q), least·w⁰_q) with one multiplier a condition,
/// is solved by Newton's method with line search (Li & Swetits 1997); the conditions are made orthonormal
/// under w⁰ first, so they may be badly scaled or repeat each other.
/// Throws std::invalid_argument when sizes differ or a weight is not positive.
NearestWeights nearest_weights(const WeightConditions& conditions, const Vector& w0,
                               const NearestWeightsOptions& options = {});

}  // namespace polyaffine
