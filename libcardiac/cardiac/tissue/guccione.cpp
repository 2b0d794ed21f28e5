#include <utility>

#include <cardiac/tissue/guccione.hpp>
#include <polyaffine/material/lagrangian_response.hpp>

namespace cardiac {
namespace {

using namespace polyaffine;

LagrangianResponse lagrangian_response(const GuccioneParameters& p, const SymPack& C, bool tangent) {
  const double b[6] = {p.bf, p.bt, p.bt, p.bfs, p.bt, p.bfs};
  LagrangianResponse l{};
  SymPack bE;
  Pack Q = broadcast(0);
#pragma GCC unroll 6
  for (int a = 0; a < 6; ++a) {
    const Pack E = 0.5 * (a < 3 ? C.v[a] - 1 : C.v[a]);
    bE.v[a] = b[a] * E;
    Q += (a < 3 ? 1.0 : 2.0) * E * bE.v[a];
  }
  const Pack Ce = p.C_kPa * exp(Q);
  l.W = 0.5 * (Ce - p.C_kPa);
#pragma GCC unroll 6
  for (int a = 0; a < 6; ++a) l.S.v[a] = Ce * bE.v[a];
  if (!tangent) return l;
#pragma GCC unroll 6
  for (int a = 0; a < 6; ++a) {
#pragma GCC unroll 6
    for (int c = 0; c < 6; ++c) l.CC[a][c] = 2 * l.S.v[a] * bE.v[c];
    l.CC[a][a] += (a < 3 ? b[a] : 0.5 * b[a]) * Ce;
  }
  return l;
}

}  // namespace

Guccione::Guccione(GuccioneParameters parameters, const FibreAxes& axes, std::vector<double> factor)
    : parameters_(parameters), axes_(axes), factor_(std::move(factor)) {
  require_positive("Guccione C", parameters.C_kPa, "kPa");
  require_not_negative("Guccione bf", parameters.bf, "1 (dimensionless)");
  require_not_negative("Guccione bt", parameters.bt, "1 (dimensionless)");
  require_not_negative("Guccione bfs", parameters.bfs, "1 (dimensionless)");
  factor_.require_size(axes_.size());
}

void Guccione::respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const {
  const Mat3Pack& f = at.F;
  const Mat3Pack R = axes_.at(points);
  const Mat3Pack local = to_local_axes(f, R);
  const SymPack C = right_cauchy_green(local);
  LagrangianResponse l;
  if (parameters_.isochoric) {
    const IsochoricStrain strain = isochoric_strain(C, determinant(f, cofactor(f)));
    l = lagrangian_response(parameters_, strain.C_bar, tangent);
    make_isochoric(strain, tangent, l);
  } else {
    l = lagrangian_response(parameters_, C, tangent);
  }
  add_lagrangian(local, l, tangent, r);
  from_local_axes(R, tangent, r);
  factor_.apply(points, tangent, r);
}

}  // namespace cardiac
