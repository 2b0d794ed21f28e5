#include <utility>

#include <polyaffine/material/linear_elastic.hpp>

namespace polyaffine {

LinearElastic::LinearElastic(const Elasticity& elasticity, std::vector<double> factor)
    : lame_(lame(elasticity)), factor_(std::move(factor)) {}

void LinearElastic::respond(PackPoints points, const PackMotion& at, bool tangent, PackResponse& r) const {
  const Mat3Pack& f = at.F;
  const auto [lambda, mu] = lame_;
  const Pack trace = f(0, 0) + f(1, 1) + f(2, 2) - 3;
  r.W = 0.5 * lambda * trace * trace;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int a = i + 3 * j;
      const Pack strain = i == j ? f(i, i) - 1 : 0.5 * (f(i, j) + f(j, i));
      r.W += mu * strain * strain;
      r.P[a] = 2 * mu * strain;
      if (i == j) r.P[a] += lambda * trace;
      if (!tangent) continue;
      for (int b = 0; b <= a; ++b) {
        const int k = b % 3, l = b / 3;
        r.A[a][b] =
            broadcast(lambda * (i == j && k == l) + mu * (i == k && j == l) + mu * (i == l && j == k));
      }
    }
  factor_.apply(points, tangent, r);
}

}  // namespace polyaffine
