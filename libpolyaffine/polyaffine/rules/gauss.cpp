#include "polyaffine/rules/gauss.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace polyaffine {
namespace {

// All distinct permutations of one barycentric point, with one weight.
template <int N>
struct Orbit {
  std::array<double, N> point;
  double weight;
};

template <int N>
void expand(const std::vector<Orbit<N>>& orbits, Eigen::Matrix<double, N, Eigen::Dynamic>& barycentric,
            Vector& weights) {
  std::vector<std::array<double, N>> points;
  std::vector<double> w;
  for (const Orbit<N>& orbit : orbits) {
    std::array<double, N> p = orbit.point;
    std::sort(p.begin(), p.end());
    do {
      points.push_back(p);
      w.push_back(orbit.weight);
    } while (std::next_permutation(p.begin(), p.end()));
  }
  barycentric.resize(N, static_cast<Eigen::Index>(points.size()));
  weights.resize(static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    for (int k = 0; k < N; ++k) barycentric(k, i) = points[i][k];
    weights[i] = w[i];
  }
}

Orbit<4> four(double a, double weight) {
  return {{a, a, a, 1 - 3 * a}, weight};
}
Orbit<4> six(double a, double weight) {
  return {{a, a, 0.5 - a, 0.5 - a}, weight};
}
Orbit<4> twelve(double a, double b, double weight) {
  return {{a, a, b, 1 - 2 * a - b}, weight};
}
Orbit<3> three(double a, double weight) {
  return {{a, a, 1 - 2 * a}, weight};
}

std::vector<Orbit<4>> tet_orbits(int degree) {
  switch (degree) {
    case 1:
      return {{{0.25, 0.25, 0.25, 0.25}, 1}};
    case 2:
      return {four((5 - std::sqrt(5.0)) / 20, 0.25)};
    case 3:
      return {four(0.3280546967114266, 0.1385279665118621), four(0.1069522739329307, 0.1114720334881379)};
    case 4:
    case 5:
      return {four(0.3108859192633006, 0.1126879257180158), four(0.09273525031089123, 0.07349304311636195),
              six(0.04550370412564965, 0.04254602077708147)};
    case 6:
      return {four(0.2146028712591520, 0.03992275025816749), four(0.04067395853461135, 0.01007721105532064),
              four(0.3223378901422755, 0.05535718154365472),
              twelve(0.06366100187501753, 0.2696723314583158, 27.0 / 560)};
    default:
      throw std::invalid_argument("tet_rule: found degree " + std::to_string(degree) + ", expected 1 to 6");
  }
}

std::vector<Orbit<3>> triangle_orbits(int degree) {
  const double s = std::sqrt(15.0);
  switch (degree) {
    case 1:
      return {{{1.0 / 3, 1.0 / 3, 1.0 / 3}, 1}};
    case 2:
      return {three(1.0 / 6, 1.0 / 3)};
    case 3:
    case 4:
      return {three(0.4459484909159649, 0.2233815896780115), three(0.09157621350977074, 0.1099517436553219)};
    case 5:
      return {{{1.0 / 3, 1.0 / 3, 1.0 / 3}, 9.0 / 40},
              three((6 - s) / 21, (155 - s) / 1200),
              three((6 + s) / 21, (155 + s) / 1200)};
    case 6:
      return {three(0.2492867451709104, 0.1167862757263794),
              three(0.06308901449150223, 0.05084490637020682),
              {{0.05314504984481695, 0.3103524510337844, 1 - 0.05314504984481695 - 0.3103524510337844},
               0.08285107561837358}};
    default:
      throw std::invalid_argument("triangle_rule: found degree " + std::to_string(degree) +
                                  ", expected 1 to 6");
  }
}

}  // namespace

TetRule tet_rule(int degree) {
  TetRule rule;
  expand<4>(tet_orbits(degree), rule.barycentric, rule.weights);
  return rule;
}

TriangleRule triangle_rule(int degree) {
  TriangleRule rule;
  expand<3>(triangle_orbits(degree), rule.barycentric, rule.weights);
  return rule;
}

LineRule line_rule(int n) {
  if (n < 1)
    throw std::invalid_argument("line_rule: found " + std::to_string(n) + " points, expected n >= 1");
  LineRule rule{Vector(n), Vector(n)};
  for (int i = 0; i < n; ++i) {
    double x = std::cos(kPi * (n - i - 0.25) / (n + 0.5));
    double slope = 0;
    // Newton on the Legendre polynomial; its quadratic convergence from this start needs at most five steps.
    for (int step = 0; step < 10; ++step) {
      double before = 1, value = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = n * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    rule.points[i] = (1 + x) / 2;
    rule.weights[i] = 1 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

QuadraturePoints gauss_points(const TetMesh& mesh, int degree) {
  const TetRule rule = tet_rule(degree);
  const Eigen::Index per_tet = rule.weights.size();
  QuadraturePoints points;
  points.tet.reserve(per_tet * mesh.num_tets());
  points.barycentric.resize(4, per_tet * mesh.num_tets());
  points.weights.resize(per_tet * mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t) {
    points.tet.insert(points.tet.end(), per_tet, t);
    points.barycentric.middleCols(t * per_tet, per_tet) = rule.barycentric;
    points.weights.segment(t * per_tet, per_tet) = mesh.tet_volume(t) * rule.weights;
  }
  return points;
}

Points positions(const TetMesh& mesh, const QuadraturePoints& points) {
  Points x(3, points.size());
  for (int i = 0; i < points.size(); ++i) {
    x.col(i).setZero();
    for (int k = 0; k < 4; ++k)
      x.col(i) += points.barycentric(k, i) * mesh.points().col(mesh.tets()(k, points.tet[i]));
  }
  return x;
}

Vector interpolate(const TetMesh& mesh, const Vector& vertex_values, const QuadraturePoints& points) {
  Vector values = Vector::Zero(points.size());
  for (int i = 0; i < points.size(); ++i)
    for (int k = 0; k < 4; ++k)
      values[i] += points.barycentric(k, i) * vertex_values[mesh.tets()(k, points.tet[i])];
  return values;
}

}  // namespace polyaffine
