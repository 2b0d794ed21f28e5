#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include <cardiac/reduction/discretisation.hpp>

#include "support/heart_run.hpp"

namespace cardiac {
namespace {

using polyaffine::Mat3;
using polyaffine::Matrix;
using polyaffine::Vec3;
using polyaffine::Vector;

// Largest relative L2 distance of the nine displacements X_j e_i and the three translations from the
// functions of a reduced model, over the wall up to the last ring: above it the base holds them all.
double affine_distance(const std::vector<std::string>& settings) {
  const Protocol p = testing::shipped_protocol("passive_inflation", testing::on_land_ellipsoid(settings));
  const auto anatomy = testing::read_anatomy(p);
  const Discretisation d = reduced_discretisation(*anatomy, p);
  const auto& coordinates = *anatomy->coordinates;
  const auto points = coordinates.space().wall_points(2);
  const int n = 3 * d.basis->num_functions();
  Matrix gram = Matrix::Zero(n, n), f = Matrix::Zero(n, 12);
  Vector size = Vector::Zero(12);
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const auto k = static_cast<Eigen::Index>(q);
    if (coordinates.wall_sample(points.tet[q], points.barycentric.col(k)).u > d.layout.rings.back().u)
      continue;
    const Vec3 X = coordinates.position(points.tet[q], points.barycentric.col(k)) - coordinates.base_centre();
    Eigen::Matrix<double, 3, 12> u;
    for (int j = 0; j < 4; ++j) u.middleCols<3>(3 * j) = (j < 3 ? X[j] : 1.0) * Mat3::Identity();
    const auto s = d.basis->sample(points.tet[q], points.barycentric.col(k));
    const auto axes = [&](int function) {
      return d.basis->in_local_axes(function) ? s.Q : Mat3(Mat3::Identity());
    };
    const double w = points.weights[k];
    size += w * u.colwise().squaredNorm().transpose();
    for (std::size_t a = 0; a < s.functions.size(); ++a) {
      const double N = w * s.N[static_cast<Eigen::Index>(a)];
      const Mat3 A = axes(s.functions[a]).transpose();
      f.middleRows<3>(3 * s.functions[a]) += N * A * u;
      for (std::size_t b = 0; b < s.functions.size(); ++b)
        gram.block<3, 3>(3 * s.functions[a], 3 * s.functions[b]) +=
            N * s.N[static_cast<Eigen::Index>(b)] * A * axes(s.functions[b]);
    }
  }
  // Functions that live above the last ring have no part in it.
  gram.diagonal().array() += 1e-10 * gram.diagonal().maxCoeff();
  const Matrix c = gram.ldlt().solve(f);
  double worst = 0;
  for (int k = 0; k < 12; ++k) {
    const double rest = size[k] - 2 * c.col(k).dot(f.col(k)) + c.col(k).dot(gram * c.col(k));
    worst = std::max(worst, std::sqrt(std::max(rest, 0.0) / size[k]));
  }
  return worst;
}

// Heart axes turn along the wall, so that tents in them hold no affine map exactly, not even a translation;
// frames of regions do (verification/elasticity/patch_test.cpp).
TEST(AffineMaps, ComeCloserWithFunctionsAndWithNodes) {
  const double fast = affine_distance({}), accurate = affine_distance({"reduction.preset=accurate"}),
               finer =
                   affine_distance({"reduction.preset=accurate", "reduction.ring_nodes=[6,8,8,8,10,10,10]"});
  EXPECT_LT(fast, 0.04);
  EXPECT_LT(accurate, 0.03);
  EXPECT_LT(finer, 0.01);
  EXPECT_GT(finer, 1e-3);
}

}  // namespace
}  // namespace cardiac
