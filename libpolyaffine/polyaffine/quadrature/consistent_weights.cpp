#include "polyaffine/quadrature/consistent_weights.hpp"

#include <utility>

namespace polyaffine {

ConsistentWeights consistent_weights(const WeightConditions& constraint, const WeightConditions& moments,
                                     const Vector& w0, const NearestWeightsOptions& options) {
  NearestWeights both = nearest_weights(stack(constraint, moments), w0, options);
  if (both.met) return {std::move(both.weights), true, true};
  NearestWeights first = nearest_weights(constraint, w0, options);
  return {std::move(first.weights), first.met, false};
}

}  // namespace polyaffine
