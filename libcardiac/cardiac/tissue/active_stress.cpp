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
}

}  // namespace cardiac
