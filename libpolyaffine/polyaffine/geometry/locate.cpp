#include "polyaffine/geometry/locate.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <sstream>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Closest point of a triangle, as barycentric coordinates (Ericson 2005, section 5.1.5).
Vec3 closest_on_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const double d1 = ab.dot(x - a), d2 = ac.dot(x - a);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = ab.dot(x - b), d4 = ac.dot(x - b);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double d5 = ab.dot(x - c), d6 = ac.dot(x - c);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  return Vec3(va, vb, vc) / (va + vb + vc);
}

// Replaces `best` when face v of tet t comes closer to x.
void offer_face(const TetMesh& mesh, const Vec3& x, int t, const Eigen::Vector3i& v, MeshPoint& best) {
  const Vec3 a = mesh.points().col(v[0]), b = mesh.points().col(v[1]), c = mesh.points().col(v[2]);
  const Vec3 lambda = closest_on_triangle(x, a, b, c);
  const double distance = (lambda[0] * a + lambda[1] * b + lambda[2] * c - x).norm();
  if (distance >= best.distance) return;
  best = {t, Vec4::Zero(), distance};
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i)
      if (mesh.tets()(k, t) == v[i]) best.barycentric[k] = lambda[i];
}

// x in tet t, with tet = −1 when it is outside.
MeshPoint inside(const TetMesh& mesh, const Vec3& x, int t) {
  constexpr double kRounding = 1e-12;
  for (int d = 0; d < 3; ++d) {
    double low = kInfinity, high = -kInfinity;
    for (int k = 0; k < 4; ++k) {
      const double p = mesh.points()(d, mesh.tets()(k, t));
      low = std::min(low, p);
      high = std::max(high, p);
    }
    if (x[d] < low - kRounding * (high - low) || x[d] > high + kRounding * (high - low)) return {};
  }
  Vec4 lambda = barycentric(mesh, t, x);
  if (lambda.minCoeff() < -kRounding) return {};
  lambda = lambda.cwiseMax(0);
  return {t, lambda / lambda.sum(), 0};
}

void check(const Vec3& x, size_t tets) {
  if (x.allFinite() && tets > 0) return;
  std::ostringstream out;
  out << "point (" << x.transpose() << ") mm to locate among " << tets
      << " tets: expected finite coordinates and at least one tet";
  throw InputError(out.str());
}

}  // namespace

Vec4 barycentric(const TetMesh& mesh, int t, const Vec3& x) {
  const Eigen::Vector4i v = mesh.tets().col(t);
  const Vec3 origin = mesh.points().col(v[0]);
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = mesh.points().col(v[k + 1]) - origin;
  Vec4 lambda;
  lambda.tail<3>() = edges.inverse() * (x - origin);
  lambda[0] = 1 - lambda.tail<3>().sum();
  return lambda;
}

Vec3 position(const TetMesh& mesh, int t, const Vec4& barycentric) {
  Vec3 x = Vec3::Zero();
  for (int k = 0; k < 4; ++k) x += barycentric[k] * mesh.points().col(mesh.tets()(k, t));
  return x;
}

MeshPoint locate(const TetMesh& mesh, const Vec3& x) {
  check(x, mesh.num_tets());
  for (int t = 0; t < mesh.num_tets(); ++t)
    if (const MeshPoint found = inside(mesh, x, t); found.tet >= 0) return found;
  MeshPoint best;
  best.distance = kInfinity;
  for (Eigen::Index f = 0; f < mesh.boundary().cols(); ++f)
    offer_face(mesh, x, mesh.boundary_tets()[f], mesh.boundary().col(f), best);
  return best;
}

MeshPoint locate(const TetMesh& mesh, const Vec3& x, const std::vector<int>& tets) {
  check(x, tets.size());
  for (const int t : tets)
    if (const MeshPoint found = inside(mesh, x, t); found.tet >= 0) return found;
  MeshPoint best;
  best.distance = kInfinity;
  for (const int t : tets) {
    const Eigen::Vector4i v = mesh.tets().col(t);
    for (int k = 0; k < 4; ++k)
      offer_face(mesh, x, t, {v[(k + 1) % 4], v[(k + 2) % 4], v[(k + 3) % 4]}, best);
  }
  return best;
}

}  // namespace polyaffine
