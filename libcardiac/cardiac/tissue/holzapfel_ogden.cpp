#include <string>
#include <utility>

#include <cardiac/tissue/holzapfel_ogden.hpp>
#include <polyaffine/material/lagrangian_response.hpp>

namespace cardiac {
namespace {

using namespace polyaffine;

// A function of one invariant with its two derivatives.
struct Scalar {
  Pack value, first, second;
};

// a/2b (e^{b x²} − 1)
Scalar quadratic_exponential(double a, double b, const Pack& x) {
  const Pack e = exp(b * x * x);
  return {a / (2 * b) * (e - 1), a * x * e, a * (1 + 2 * b * x * x) * e};
}

// χ(1 + x) a/2b (e^{b x²} − 1), x = I₄ − 1
Scalar switched(double a, double b, double k, const Pack& x) {
  const Scalar g = quadratic_exponential(a, b, x);
  const Pack chi = 1 / (1 + exp(-k * x));
  const Pack chi1 = k * chi * (1 - chi), chi2 = k * (1 - 2 * chi) * chi1;
  return {chi * g.value, chi1 * g.value + chi * g.first,
          chi2 * g.value + 2 * chi1 * g.first + chi * g.second};
}

void require_exponential(const char* name, double a, double b) {
  require_not_negative(std::string("Holzapfel-Ogden a") + name, a, "kPa");
  require_positive(std::string("Holzapfel-Ogden b") + name, b, "1 (dimensionless)");
}

}  // namespace

HolzapfelOgden::HolzapfelOgden(HolzapfelOgdenParameters parameters, const FibreAxes& axes,
                               std::vector<double> factor)
    : parameters_(parameters), axes_(axes), factor_(std::move(factor)) {
  const HolzapfelOgdenParameters& p = parameters_;
  require_exponential("", p.a_kPa, p.b);
  require_positive("Holzapfel-Ogden a", p.a_kPa, "kPa");
  require_exponential("_f", p.a_f_kPa, p.b_f);
  require_exponential("_s", p.a_s_kPa, p.b_s);
  require_exponential("_fs", p.a_fs_kPa, p.b_fs);
  require_not_negative("Holzapfel-Ogden switch steepness", p.switch_steepness, "1 (dimensionless)");
  factor_.require_size(axes_.size());
}

void HolzapfelOgden::respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const {
  const Mat3Pack& f = at.F;
  const HolzapfelOgdenParameters& p = parameters_;
  const Mat3Pack R = axes_.at(points);
  const Mat3Pack local = to_local_axes(f, R);
  const SymPack C = right_cauchy_green(local);
  const IsochoricStrain strain = isochoric_strain(C, determinant(f, cofactor(f)));

  const Pack I1 = strain.C_bar.v[0] + strain.C_bar.v[1] + strain.C_bar.v[2];
  const Pack stiffness = p.a_kPa * exp(p.b * (I1 - 3));
  LagrangianResponse l{};
  l.W = (stiffness - p.a_kPa) / (2 * p.b);
  for (int i = 0; i < 3; ++i) {
    l.S.v[i] = stiffness;
    for (int j = 0; j < 3; ++j) l.CC[i][j] = 2 * p.b * stiffness;
  }
  make_isochoric(strain, tangent, l);

  const Scalar along[2] = {switched(p.a_f_kPa, p.b_f, p.switch_steepness, C.v[0] - 1),
                           switched(p.a_s_kPa, p.b_s, p.switch_steepness, C.v[1] - 1)};
  for (int i = 0; i < 2; ++i) {
    l.W += along[i].value;
    l.S.v[i] += 2 * along[i].first;
    l.CC[i][i] += 4 * along[i].second;
  }
  const Scalar shear = quadratic_exponential(p.a_fs_kPa, p.b_fs, C(0, 1));
  l.W += shear.value;
  l.S(0, 1) += shear.first;
  l.CC[3][3] += shear.second;

  add_lagrangian(local, l, tangent, r);
  from_local_axes(R, tangent, r);
  factor_.apply(points, tangent, r);
}

}  // namespace cardiac
