#include "polyaffine/solve/secant_updates.hpp"

#include <cmath>

namespace polyaffine {
namespace {

constexpr std::size_t kPairs = 12;
constexpr double kContraction = 0.9;  // of a step along the last one, at most, for a pair to be learnt

}  // namespace

void SecantUpdates::clear() {
  pairs_.clear();
  restart();
}

void SecantUpdates::improve(const Eigen::Ref<const Vector>& weights, Vector& x) {
  for (const auto& [u, v] : pairs_) x += v.dot(x) * u;
  if (step_.size() > 0 && pairs_.size() < kPairs) {
    Vector v = weights.cwiseAbs2().cwiseProduct(step_);
    const double before = v.dot(step_), after = v.dot(x);
    if (std::abs(after) < kContraction * before) {
      Vector u = x / (before - after);
      x *= before / (before - after);
      pairs_.push_back({std::move(u), std::move(v)});
    }
  }
  step_ = x;
}

}  // namespace polyaffine
