#include <utility>

#include <polyaffine/material/lagrangian_response.hpp>
#include <polyaffine/material/saint_venant_kirchhoff.hpp>

namespace polyaffine {

SaintVenantKirchhoff::SaintVenantKirchhoff(const Elasticity& elasticity, std::vector<double> factor)
    : lame_(lame(elasticity)), factor_(std::move(factor)) {}

void SaintVenantKirchhoff::respond(PackPoints points, const PackMotion& at, bool tangent,
                                   PackResponse& r) const {
  const Mat3Pack& f = at.F;
  const auto [lambda, mu] = lame_;
  SymPack E = right_cauchy_green(f);
  for (int a = 0; a < 6; ++a) E.v[a] = 0.5 * (a < 3 ? E.v[a] - 1 : E.v[a]);
  const Pack trace = E.v[0] + E.v[1] + E.v[2];
  LagrangianResponse l{};
  l.W = mu * contract(E, E) + 0.5 * lambda * trace * trace;
  for (int a = 0; a < 6; ++a) {
    l.S.v[a] = 2 * mu * E.v[a];
    if (a < 3) l.S.v[a] += lambda * trace;
    for (int b = 0; b < 6; ++b)
      l.CC[a][b] = broadcast((a < 3 && b < 3 ? lambda : 0) + (a == b ? (a < 3 ? 2 : 1) * mu : 0));
  }
  add_lagrangian(f, l, tangent, r);
  factor_.apply(points, tangent, r);
}

}  // namespace polyaffine
