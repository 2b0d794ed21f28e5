#pragma once

#include <polyaffine/quadrature/nearest_weights.hpp>

namespace polyaffine {

struct ConsistentWeights {
  Vector weights;        ///< ≥ 0, mm³
  bool met = false;      ///< they meet the integration constraint
  bool moments = false;  ///< they keep the regions' volumes and first moments as well
};

/// The weights nearest to w⁰ that meet the integration constraint and, where the points allow it, the
/// conditions `moments` too; few points under many functions leave room only for the first, or for neither:
/// then other points have to be drawn. Where affine maps are among the functions, the constraint alone keeps
/// the whole volume.
ConsistentWeights consistent_weights(const WeightConditions& constraint, const WeightConditions& moments,
                                     const Vector& w0, const NearestWeightsOptions& options = {});

}  // namespace polyaffine
