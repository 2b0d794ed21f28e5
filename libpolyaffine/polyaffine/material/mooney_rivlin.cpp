#include <utility>

#include <polyaffine/material/lagrangian_response.hpp>
#include <polyaffine/material/mooney_rivlin.hpp>

namespace polyaffine {

MooneyRivlin::MooneyRivlin(MooneyRivlinParameters parameters, std::vector<double> factor)
    : parameters_(parameters), factor_(std::move(factor)) {
  require_not_negative("Mooney-Rivlin c1", parameters.c1, "kPa");
  require_not_negative("Mooney-Rivlin c2", parameters.c2, "kPa");
  require_positive("Mooney-Rivlin c1 + c2", parameters.c1 + parameters.c2, "kPa");
}

void MooneyRivlin::respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const {
  const Mat3Pack& f = at.F;
  const auto [c1, c2] = parameters_;
  const IsochoricStrain strain = isochoric_strain(right_cauchy_green(f), determinant(f, cofactor(f)));
  const SymPack& C = strain.C_bar;
  const Pack I1 = C.v[0] + C.v[1] + C.v[2];
  LagrangianResponse l{};
  l.W = c1 * (I1 - 3) + c2 * (0.5 * (I1 * I1 - contract(C, C)) - 3);
  for (int a = 0; a < 6; ++a) l.S.v[a] = (a < 3 ? 2 * (c1 + c2 * I1) : Pack{}) - 2 * c2 * C.v[a];
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      if (a != b) l.CC[a][b] += 4 * c2;
  for (int a = 3; a < 6; ++a) l.CC[a][a] -= 2 * c2;
  make_isochoric(strain, tangent, l);
  add_lagrangian(f, l, tangent, r);
  factor_.apply(points, tangent, r);
}

}  // namespace polyaffine
