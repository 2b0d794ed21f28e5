#include <cmath>

#include <cardiac/tissue/fibre_tension.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/material/parameters.hpp>

namespace cardiac {

using namespace polyaffine;

FibreTension::FibreTension(const FibreAxes& axes, double cross_fibre_fraction)
    : axes_(axes), cross_fibre_fraction_(cross_fibre_fraction) {
  require(cross_fibre_fraction >= 0 && cross_fibre_fraction <= 1, "cross-fibre fraction of active tension",
          cross_fibre_fraction, "a dimensionless number from 0 to 1");
}

void FibreTension::respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const {
  const auto size = static_cast<std::size_t>(axes_.size());
  if (at.state.size() != 2 * size)
    throw ComputationError("fibre tension: the state does not hold two numbers a point");
  const Mat3Pack& F = at.F;
  const Mat3Pack R = axes_.at(points);
  const Pack tension = gather(at.state.data() + points.point, 1, points.lanes);
  Pack along[9], across[9];  // ∂λ_f/∂F, ∂λ_s/∂F + ∂λ_n/∂F
  for (Pack& entry : across) entry = broadcast(0);
  const int axes = cross_fibre_fraction_ > 0 ? 3 : 1;
  for (int a = 0; a < axes; ++a) {
    const Pack share = a == 0 ? tension : cross_fibre_fraction_ * tension;
    Pack n[3], square = broadcast(0);
    for (int i = 0; i < 3; ++i) {
      n[i] = F(i, 0) * R(0, a) + F(i, 1) * R(1, a) + F(i, 2) * R(2, a);
      square += n[i] * n[i];
    }
    Pack stretch;
    for (int lane = 0; lane < kLanes; ++lane) stretch[lane] = std::sqrt(square[lane]);
    for (Pack& entry : n) entry = entry / stretch;
    r.W += share * (stretch - 1);
    for (int J = 0; J < 3; ++J)
      for (int i = 0; i < 3; ++i) {
        const Pack by_F = n[i] * R(J, a);
        r.P[i + 3 * J] += share * by_F;
        if (a == 0) along[i + 3 * J] = by_F;
        if (a > 0) across[i + 3 * J] += by_F;
      }
    if (!tangent) continue;
    const Pack geometric = share / stretch;
    for (int J = 0; J < 3; ++J)
      for (int i = 0; i < 3; ++i)
        for (int L = 0; L <= J; ++L)
          for (int k = 0; k < 3; ++k)
            r.A[i + 3 * J][k + 3 * L] += geometric * ((i == k ? 1.0 : 0.0) - n[i] * n[k]) * R(J, a) * R(L, a);
  }
  if (!tangent) return;
  const Pack stiffness = gather(at.state.data() + size + points.point, 1, points.lanes);
  const double half = 0.5 * cross_fibre_fraction_;
  for (int p = 0; p < 9; ++p)
    for (int q = 0; q <= p; ++q)
      r.A[p][q] += stiffness * (along[p] * along[q] + half * (along[p] * across[q] + across[p] * along[q]));
}

}  // namespace cardiac
