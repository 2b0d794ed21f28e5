#include "polyaffine/quadrature/consistent_weights.hpp"

#include <sstream>
#include <utility>

#include <polyaffine/core/error.hpp>

namespace polyaffine {

ConsistentWeights consistent_weights(const WeightConditions& constraint, const WeightConditions& moments,
                                     const Vector& w0, const NearestWeightsOptions& options) {
  NearestWeights both = nearest_weights(stack(constraint, moments), w0, options);
  if (both.met) return {std::move(both.weights), true};
  NearestWeights first = nearest_weights(constraint, w0, options);
  if (first.met) return {std::move(first.weights), false};
  std::ostringstream out;
  out << "integration weights: " << w0.size()
      << " points with weights >= 0 miss the integration constraint of " << constraint.b.size() / 3
      << " functions by a fraction " << first.miss << ", expected at most " << options.tolerance
      << "; more points or fewer functions are needed";
  throw ComputationError(out.str());
}

}  // namespace polyaffine
