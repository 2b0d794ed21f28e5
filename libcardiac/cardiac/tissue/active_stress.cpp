#include <cmath>
#include <utility>

#include <cardiac/tissue/active_stress.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/material/lagrangian_response.hpp>
#include <polyaffine/material/parameters.hpp>

namespace cardiac {

using namespace polyaffine;

ActiveStress::ActiveStress(const FibreAxes& axes, double cross_fibre_fraction)
    : axes_(axes), cross_fibre_fraction_(cross_fibre_fraction) {
  require(cross_fibre_fraction >= 0 && cross_fibre_fraction <= 1, "cross-fibre fraction of active tension",
          cross_fibre_fraction, "a dimensionless number from 0 to 1");
}

void ActiveStress::respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const {
  const Mat3Pack& f = at.F;
  const PointState tension_kPa = at.state;
  if (tension_kPa.size() < static_cast<std::size_t>(points.point) + static_cast<std::size_t>(points.lanes))
    throw ComputationError("active stress: the state holds fewer tensions than there are points");
  const Mat3Pack R = axes_.at(points);
  const Pack tension = gather(tension_kPa.data() + points.point, 1, points.lanes);
  const Pack cross = cross_fibre_fraction_ * tension;
  SymPack S;
  for (int a = 0; a < 6; ++a) {
    const int i = kVoigtRow[a], j = kVoigtColumn[a];
    S.v[a] = (tension - cross) * R(i, 0) * R(j, 0);
    if (i == j) S.v[a] += cross;
  }
  const Pack energy = 0.5 * (contract(right_cauchy_green(f), S) - tension - 2 * cross);
  add_constant_stress(f, energy, S, tangent, r);
  if (tangent && tension_kPa.size() == 2 * static_cast<std::size_t>(axes_.size())) add_change(points, at, r);
}

// Of the tension with the stretch, in the tangent.
void ActiveStress::add_change(PackPoints points, const PackMotion& at, PackResponse& r) const {
  const Mat3Pack& F = at.F;
  const Mat3Pack R = axes_.at(points);
  const Pack change = gather(at.state.data() + axes_.size() + points.point, 1, points.lanes);
  Pack moved[3], square = broadcast(0);  // F f
  for (int i = 0; i < 3; ++i) {
    moved[i] = F(i, 0) * R(0, 0) + F(i, 1) * R(1, 0) + F(i, 2) * R(2, 0);
    square += moved[i] * moved[i];
  }
  Pack half;  // κ/2λ
  for (int lane = 0; lane < kLanes; ++lane) half[lane] = 0.5 * change[lane] / std::sqrt(square[lane]);
  Pack along[9], stress[9];  // F f⊗f = λ ∂λ/∂F, and F S/τ
  for (int J = 0; J < 3; ++J)
    for (int i = 0; i < 3; ++i) {
      along[i + 3 * J] = moved[i] * R(J, 0);
      stress[i + 3 * J] = (1 - cross_fibre_fraction_) * along[i + 3 * J] + cross_fibre_fraction_ * F(i, J);
    }
  for (int p = 0; p < 9; ++p)
    for (int q = 0; q <= p; ++q) r.A[p][q] += half * (along[p] * stress[q] + stress[p] * along[q]);
}

}  // namespace cardiac
