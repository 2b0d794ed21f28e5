#include "cardiac/contraction/sarcomere.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace cardiac {

Overlap filament_overlap(double stretch, double beta0) {
  constexpr double kKnee = 0.87, kLongest = 1.2;
  const double l = std::min(stretch, kLongest);
  const double h = 1 + beta0 * (l + std::min(l, kKnee) - 1 - kKnee);
  if (h <= 0) return {0, 0};
  return {h, stretch >= kLongest ? 0 : beta0 * (l < kKnee ? 2 : 1)};
}

RestingTension resting_tension(const SarcomereModel& model, double drive, double stretch) {
  const auto z = model.at_rest(drive, stretch);
  SarcomereResponse r;
  model.respond({drive, stretch, 0}, z, true, r);
  // dz/dλ = −(∂g/∂z)⁻¹ ∂g/∂λ
  const int n = model.num_states();
  Eigen::MatrixXd by_state(n, n);
  Eigen::VectorXd by_stretch(n), tension(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) by_state(i, j) = r.rates_by_state[i][j];
    by_stretch[i] = r.rates_by_stretch[i];
    tension[i] = r.by_state[i];
  }
  return {r.tension_kPa, r.by_stretch - tension.dot(by_state.partialPivLu().solve(by_stretch))};
}

}  // namespace cardiac
