#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>

#include <polyaffine/check/derivative_check.hpp>
#include <polyaffine/geometry/locate.hpp>
#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/material/linear_elastic.hpp>
#include <polyaffine/quadrature/elastons.hpp>
#include <polyaffine/system/field_energy.hpp>

#include "polyaffine/geometry/box_mesh.hpp"
#include "support/matrix_system.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

constexpr double kLambda = 40, kMu = 10;  // kPa

struct Scene {
  TetMesh mesh = box_mesh(Vec3(1, -2, 0), Vec3(4, 0, 1), {9, 6, 3}, 0.2);
  IntegrationRegions regions;

  explicit Scene(int count) {
    std::mt19937_64 random(9);
    regions =
        integration_regions(EikonalSolver(mesh), std::vector<int>(mesh.num_tets(), 0), 1, count, random);
  }
};

TEST(Moments, OfABoxAreTheTextbookOnes) {
  const Scene scene(1);
  Moments sum = Moments::Zero();
  for (int t = 0; t < scene.mesh.num_tets(); ++t) sum += tet_moments(scene.mesh, t, Vec3(2.5, -1, 0.5));
  const Moments exact = 6 * Vec4(1, 9.0 / 12, 4.0 / 12, 1.0 / 12).asDiagonal().toDenseMatrix();  // V l²/12
  EXPECT_LT((sum - exact).norm(), 1e-12);
}

// u affine + quadratic with coefficients of order one: the (small) strain is linear in X.
struct LinearStrain {
  Mat3 constant;
  std::array<Mat3, 3> slope;

  LinearStrain() {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    const auto symmetric = [&] {
      const Mat3 a = Mat3::NullaryExpr([&] { return normal(random); });
      return Mat3((a + a.transpose()) / 2);
    };
    constant = symmetric();
    for (Mat3& s : slope) s = symmetric();
  }
  Mat3 at(const Vec3& x) const { return constant + x[0] * slope[0] + x[1] * slope[1] + x[2] * slope[2]; }
};

// W = ½ Σ_ab m_ab E_a : H : E_b (µJ) of the isotropic linear law with Lamé constants λ, µ for the strain E(X)
// = E_0 + Σ_k E_k (X − centre)_k (Martin et al. 2010).
double elaston_energy(const Elaston& elaston, const std::array<Mat3, 4>& strain) {
  double energy = 0;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      energy += elaston.moments(a, b) * (kLambda / 2 * strain[a].trace() * strain[b].trace() +
                                         kMu * strain[a].cwiseProduct(strain[b]).sum());
  return energy;
}

double total_energy(const Scene& scene, int order) {
  const LinearStrain field;
  double energy = 0;
  for (const Elaston& elaston : elastons(scene.mesh, scene.regions, order))
    energy +=
        elaston_energy(elaston, {field.at(elaston.centre), field.slope[0], field.slope[1], field.slope[2]});
  return energy;
}

double exact_energy(const TetMesh& mesh) {
  const LinearStrain field;
  const QuadraturePoints q = gauss_points(mesh, 2);  // the energy density is quadratic
  const Points x = positions(mesh, q);
  double energy = 0;
  for (int i = 0; i < q.size(); ++i) {
    const Mat3 e = field.at(x.col(i));
    energy += q.weights[i] * (kLambda / 2 * e.trace() * e.trace() + kMu * e.squaredNorm());
  }
  return energy;
}

TEST(Elastons, OfOrderOneAreExactForLinearStrain) {
  for (const int count : {1, 7, 30}) {
    const Scene scene(count);
    const double exact = exact_energy(scene.mesh);
    EXPECT_GT(exact, 100);
    EXPECT_NEAR(total_energy(scene, 1), exact, 1e-12 * exact);
  }
}

TEST(Elastons, OfOrderZeroMissTheBendingAndConverge) {
  const double exact = exact_energy(Scene(1).mesh);
  const double coarse = exact - total_energy(Scene(2), 0), fine = exact - total_energy(Scene(64), 0);
  EXPECT_GT(coarse, 0.02 * exact);
  // Order two in the size of the regions, whose volume falls by 32: a factor 10, less for shapes that are not
  // similar.
  EXPECT_LT(std::abs(fine), coarse / 5);
}

TEST(ElastonPoints, HaveTheMomentsOfTheirRegions) {
  const Scene scene(7);
  const QuadraturePoints points = elaston_points(scene.mesh, scene.regions, 1);
  ASSERT_EQ(points.size(), 28);
  const std::vector<Elaston> exact = elastons(scene.mesh, scene.regions, 1);
  const Points X = positions(scene.mesh, points);
  for (int i = 0; i < 7; ++i) {
    Moments sum = Moments::Zero();
    for (int q = 4 * i; q < 4 * i + 4; ++q) {
      EXPECT_EQ(points.tet[q], scene.regions.points.tet[i]);
      const Vec4 p = (Vec4() << 1, X.col(q) - exact[i].centre).finished();
      sum += points.weights[q] * p * p.transpose();
    }
    EXPECT_LT((sum - exact[i].moments).norm(), 1e-13);
  }
  EXPECT_EQ(elaston_points(scene.mesh, scene.regions, 0).size(), 7);
}

// Two functions that are quadratic in X, so that the strain is linear.
class QuadraticFunctions : public Basis {
 public:
  explicit QuadraticFunctions(const TetMesh& mesh) : mesh_(mesh) {}
  int num_functions() const override { return 2; }
  BasisSample sample(int tet, const Vec4& barycentric) const override {
    const Vec3 x = position(mesh_, tet, barycentric);
    BasisSample s;
    s.functions = {0, 1};
    s.N = (Vector(2) << x[0] * x[1] + x[2] * x[2], x[1] - x[0] * x[2]).finished();
    s.gradient.resize(3, 2);
    s.gradient << x[1], -x[2], x[0], 1, 2 * x[2], -x[0];
    return s;
  }

 private:
  const TetMesh& mesh_;
};

FieldEnergy energy_over(const Scene& scene, const QuadraturePoints& points) {
  const Lame constants{kLambda, kMu};
  const double young = constants.mu * (3 * kLambda + 2 * kMu) / (kLambda + kMu);
  return FieldEnergy(deformation_table(QuadraticFunctions(scene.mesh),
                                       {points.tet, points.barycentric, points.weights, {0, points.size()}}),
                     {std::make_shared<LinearElastic>(Elasticity{young, kLambda / (2 * (kLambda + kMu))})});
}

TEST(ElastonPoints, HaveTheElastonEnergyAndItsDerivatives) {
  const Scene scene(5);
  const FieldEnergy energy = energy_over(scene, elaston_points(scene.mesh, scene.regions, 1));
  const Vector c = testing::random_vector(6, 1, 8);
  const auto strain = [&](const Vec3& x) {
    const Vec3 a = c.head<3>(), b = c.tail<3>();
    const Mat3 h = a * Vec3(x[1], x[0], 2 * x[2]).transpose() + b * Vec3(-x[2], 1, -x[0]).transpose();
    return Mat3((h + h.transpose()) / 2);
  };
  double expected = 0;
  for (const Elaston& one : elastons(scene.mesh, scene.regions, 1)) {
    const Mat3 at = strain(one.centre);
    std::array<Mat3, 4> expansion{at};
    for (int k = 0; k < 3; ++k) expansion[k + 1] = strain(one.centre + Vec3::Unit(k)) - at;
    expected += elaston_energy(one, expansion);
  }
  ASSERT_GT(expected, 10);
  EXPECT_NEAR(energy.evaluate({c}).value, expected, 1e-12 * expected);
  const double exact = energy_over(scene, gauss_points(scene.mesh, 2)).evaluate({c}).value;
  EXPECT_NEAR(expected, exact, 1e-12 * exact);
  const double order_zero =
      energy_over(scene, elaston_points(scene.mesh, scene.regions, 0)).evaluate({c}).value;
  EXPECT_GT(exact - order_zero, 0.01 * exact);

  const auto value = [&](const Vector& x) { return energy.evaluate({x}).value; };
  const auto gradient = [&](const Vector& x) { return energy.evaluate({x}).gradient; };
  const auto tangent = [&](const Vector& x) { return testing::tangent(energy, {x}); };
  EXPECT_TRUE(check_gradient(value, gradient, c).passed);
  EXPECT_TRUE(check_jacobian(gradient, tangent, c).passed);
}

TEST(Elastons, RejectOtherOrders) {
  const Scene scene(1);
  EXPECT_THROW(elaston_points(scene.mesh, scene.regions, 2), std::invalid_argument);
  EXPECT_THROW(elastons(scene.mesh, scene.regions, 2), std::invalid_argument);
}

}  // namespace
}  // namespace polyaffine
