#include <utility>

#include <polyaffine/material/lagrangian_response.hpp>
#include <polyaffine/material/neo_hookean.hpp>

namespace polyaffine {

NeoHookean::NeoHookean(Lame lame, std::vector<double> factor) : lame_(lame), factor_(std::move(factor)) {
  require_positive("shear modulus (mu)", lame.mu, "kPa");
  require_not_negative("Lame constant (lambda)", lame.lambda, "kPa");
}

void NeoHookean::respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const {
  const Mat3Pack& f = at.F;
  const auto [lambda, mu] = lame_;
  const Mat3Pack cof = cofactor(f);
  const Pack J = determinant(f, cof), inverse = 1 / J, log_J = log(J);
  const Pack dU = (lambda * log_J - mu) * inverse;
  add_volumetric(f, cof, {(0.5 * lambda * log_J - mu) * log_J, dU, (lambda * inverse - dU) * inverse},
                 tangent, r);
  Pack I1 = broadcast(0);
  for (int a = 0; a < 9; ++a) {
    I1 += f.m[a] * f.m[a];
    r.P[a] += mu * f.m[a];
    if (tangent) r.A[a][a] += mu;
  }
  r.W += 0.5 * mu * (I1 - 3);
  factor_.apply(points, tangent, r);
}

IsochoricNeoHookean::IsochoricNeoHookean(double shear_modulus, std::vector<double> factor)
    : shear_modulus_(shear_modulus), factor_(std::move(factor)) {
  require_positive("shear modulus (mu)", shear_modulus, "kPa");
}

void IsochoricNeoHookean::respond(PackPoints points, const PackMotion& at, bool tangent,
                                  PackResponse& r) const {
  const Mat3Pack& f = at.F;
  const IsochoricStrain strain = isochoric_strain(right_cauchy_green(f), determinant(f, cofactor(f)));
  const SymPack& C = strain.C_bar;
  LagrangianResponse l{};
  l.W = 0.5 * shear_modulus_ * (C.v[0] + C.v[1] + C.v[2] - 3);
  for (int i = 0; i < 3; ++i) l.S.v[i] = broadcast(shear_modulus_);
  make_isochoric(strain, tangent, l);
  add_lagrangian(f, l, tangent, r);
  factor_.apply(points, tangent, r);
}

}  // namespace polyaffine
