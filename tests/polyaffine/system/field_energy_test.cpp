#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <memory>

#include <polyaffine/check/derivative_check.hpp>
#include <polyaffine/core/threads.hpp>
#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/material/neo_hookean.hpp>
#include <polyaffine/material/viscosity.hpp>

#include "support/labelled_box.hpp"
#include "support/matrix_system.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

using testing::labelled_box;
using testing::labelled_cube;
using testing::random_vector;
using testing::tangent;
using Laws = std::vector<std::shared_ptr<const Law>>;

constexpr double kLambda = 30, kMu = 10, kKappa = 200;  // kPa

Laws neo_hookean() {
  return {std::make_shared<NeoHookean>(Lame{kLambda, kMu})};
}
Laws isochoric() {
  return {std::make_shared<IsochoricNeoHookean>(kMu)};
}

enum class Space { none, block, region, dense };

struct Case {
  int order;
  Space space;
};

PressureSpace make_space(Space kind, const FieldTable& table, const Points& X) {
  if (kind == Space::block) return block_pressure(table, kKappa);
  if (kind == Space::region) {  // cuts through elements, so that blocks see two regions
    std::vector<int> region;
    for (int q = 0; q < table.num_points(); ++q) region.push_back(X(0, q) < 0.6 ? 0 : 1);
    return region_pressure(table, region, 2, kKappa);
  }
  Matrix values = Matrix::Ones(3, table.num_points());
  values.bottomRows(2) = X.topRows(2);
  return dense_pressure(table, values, kKappa);
}

Points positions_of(const LagrangeBasis& basis, const WallPoints& points) {
  Points X(3, points.barycentric.cols());
  for (Eigen::Index q = 0; q < X.cols(); ++q) {
    const BasisSample s = basis.sample(points.tet[q], points.barycentric.col(q));
    X.col(q) = basis.nodes()(Eigen::all, s.functions) * s.N;
  }
  return X;
}

FieldEnergy make_energy(const TetMesh& mesh, const Case& of, double viscosity = 0) {
  const LagrangeBasis basis(mesh, of.order);
  const WallPoints points = basis.wall_points(of.order == 1 ? 1 : 3);
  FieldTable table = deformation_table(basis, points);
  std::optional<PressureSpace> space;
  if (of.space != Space::none) space = make_space(of.space, table, positions_of(basis, points));
  auto laws = space ? isochoric() : neo_hookean();
  if (viscosity > 0) laws.push_back(std::make_shared<KelvinVoigt>(viscosity));
  return FieldEnergy(std::move(table), std::move(laws), space);
}

class Derivatives : public ::testing::TestWithParam<Case> {};

TEST_P(Derivatives, GradientAndTangentMatchFiniteDifferences) {
  const FieldEnergy energy = make_energy(labelled_box(Vec3::Zero(), Vec3(2, 1, 1), {2, 1, 1}), GetParam());
  for (const unsigned seed : {1U, 2U}) {
    const Vector c = random_vector(energy.table().num_unknowns(), 0.04, seed);
    const EnergyValue at = energy.evaluate({c});
    ASSERT_GT(at.min_det, 0.2);  // far from rest, far from inversion
    ASSERT_LT(at.min_det, 0.95);
    const auto gradient = [&](const Vector& x) { return energy.evaluate({x}).gradient; };
    const DerivativeReport first =
        check_gradient([&](const Vector& x) { return energy.evaluate({x}).value; }, gradient, c);
    EXPECT_TRUE(first.passed) << first.relative_error;
    const DerivativeReport second = check_jacobian(
        gradient, [&](const Vector& x) { return tangent(energy, {x}); }, c);
    EXPECT_TRUE(second.passed) << second.relative_error;
  }
}

INSTANTIATE_TEST_SUITE_P(FieldEnergy, Derivatives,
                         ::testing::Values(Case{1, Space::none}, Case{1, Space::block}, Case{2, Space::none},
                                           Case{2, Space::block}, Case{2, Space::region},
                                           Case{2, Space::dense}));

TEST(FieldEnergy, TheScaleMultipliesTheTangent) {
  for (const Space space : {Space::none, Space::block, Space::dense}) {
    const FieldEnergy energy = make_energy(labelled_cube(1), {2, space});
    const Vector c = random_vector(energy.table().num_unknowns(), 0.03, 3);
    const Matrix K = tangent(energy, {c});
    EXPECT_LT((tangent(energy, {c}, -2.5) + 2.5 * K).norm(), 1e-13 * K.norm());  // rounding
    EXPECT_LT((K - K.transpose()).norm(), 1e-13 * K.norm());
  }
}

TEST(FieldEnergy, ViscousTangentIsTheDerivativeByTheRate) {
  const FieldEnergy energy = make_energy(labelled_cube(1), {2, Space::block}, 5);
  const int n = energy.table().num_unknowns();
  const Vector c = random_vector(n, 0.04, 4);
  const Vector rate = random_vector(n, 0.1, 5);
  constexpr double kFactor = 0.7;
  const Matrix elastic = tangent(energy, {c});
  const auto force = [&](const Vector& v) { return energy.evaluate({c, {}, &v}).gradient; };
  const auto by_rate = [&](const Vector& v) {
    return ((tangent(energy, {c, {}, &v}, 1, kFactor) - elastic) / kFactor).eval();
  };
  const DerivativeReport report = check_jacobian(force, by_rate, rate);
  EXPECT_TRUE(report.passed) << report.relative_error;

  // Power of the viscous forces is the dissipation: positive, and quadratic in the rate at a fixed state.
  const Vector rest = energy.evaluate({c}).gradient;
  const double power = rate.dot(force(rate) - rest);
  const Vector twice = 2 * rate;
  EXPECT_GT(power, 0);
  EXPECT_NEAR(twice.dot(force(twice) - rest), 4 * power, 1e-11 * power);  // rounding
}

TEST(FieldEnergy, ARigidMotionStressesNothing) {
  const TetMesh mesh = labelled_cube(2, 0.2);
  const LagrangeBasis basis(mesh, 2);
  const Mat3 R = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Points x = (R * basis.nodes()).colwise() + Vec3(3, -2, 1);
  const Vector c = (x - basis.nodes()).reshaped();
  Points spin(3, x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) spin.col(i) = Vec3(0.2, -0.4, 0.3).cross(Vec3(x.col(i)));
  const Vector rate = spin.reshaped();
  for (const Space space : {Space::none, Space::block, Space::dense}) {
    const FieldEnergy energy = make_energy(mesh, {2, space}, 5);
    const EnergyValue at = energy.evaluate({c, {}, &rate});
    // Rounding of F, 1e-15, times the stiffness and the face areas.
    EXPECT_LT(at.gradient.norm(), 1e-11);
    EXPECT_NEAR(at.value, 0, 1e-12);
    EXPECT_NEAR(at.min_det, 1, 1e-13);
    EXPECT_NEAR(at.max_det, 1, 1e-13);
  }
}

class Patch : public ::testing::TestWithParam<int> {};

TEST_P(Patch, AnAffineMapGivesConstantStressAndNoInteriorForce) {
  const TetMesh mesh = labelled_cube(3, 0.25);
  const LagrangeBasis basis(mesh, GetParam());
  const FieldEnergy energy = make_energy(mesh, {GetParam(), Space::none});
  Mat3 A;
  A << 1.2, 0.1, -0.05, 0.15, 0.9, 0.2, 0, -0.1, 1.1;
  const Points u = (A - Mat3::Identity()) * basis.nodes();
  const EnergyValue at = energy.evaluate({u.reshaped()});

  const double J = A.determinant();
  const Mat3 inverse_transpose = A.inverse().transpose();
  const Mat3 P = kMu * (A - inverse_transpose) + kLambda * std::log(J) * inverse_transpose;
  const double W =
      kMu / 2 * (A.squaredNorm() - 3) - kMu * std::log(J) + kLambda / 2 * std::pow(std::log(J), 2);
  EXPECT_NEAR(at.value, W, 1e-12 * W);  // the cube has volume 1
  EXPECT_NEAR(at.min_det, J, 1e-12);
  EXPECT_NEAR(at.max_det, J, 1e-12);

  // Σ f_a ⊗ X_a = ∫ P dV for any interior and boundary nodes.
  const Points f = at.gradient.reshaped(3, basis.num_functions());
  EXPECT_LT((f * basis.nodes().transpose() - P).norm(), 1e-12 * P.norm());
  const std::vector<int> boundary = basis.surface_nodes(mesh, {1, 2, 3, 4, 5, 6});
  int interior = 0;
  for (int a = 0; a < basis.num_functions(); ++a) {
    if (std::binary_search(boundary.begin(), boundary.end(), a)) continue;
    ++interior;
    EXPECT_LT(f.col(a).norm(), 1e-13 * P.norm() * 10);  // cancellation of some 20 elements' forces
  }
  EXPECT_GE(interior, 8);
}

INSTANTIATE_TEST_SUITE_P(FieldEnergy, Patch, ::testing::Values(1, 2));

TEST(FieldEnergy, ThreadsDoNotChangeABit) {
  // 384 elements: more than the blocks that are worked on before they are added up.
  const TetMesh mesh = labelled_cube(4, 0.2);
  for (const Space space : {Space::none, Space::block, Space::dense}) {
    const FieldEnergy energy = make_energy(mesh, {1, space}, 2);
    const Vector c = random_vector(energy.table().num_unknowns(), 0.03, 6);
    const Vector rate = random_vector(energy.table().num_unknowns(), 0.03, 7);
    use_threads();
    const auto run = [&](std::size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return std::pair(energy.evaluate({c, {}, &rate}), tangent(energy, {c, {}, &rate}, 1, 0.5));
    };
    const auto one = run(1);
    for (int repeat = 0; repeat < 3; ++repeat) {
      const auto two = run(2);
      EXPECT_EQ(one.first.value, two.first.value);
      EXPECT_TRUE(one.first.gradient == two.first.gradient);
      EXPECT_TRUE(one.second == two.second);
    }
  }
}

// Forces are shared between threads only where there are more than 4096 points.
TEST(FieldEnergy, ThreadsDoNotChangeABitOfTheForcesOfManyPoints) {
  const TetMesh mesh = labelled_cube(6, 0.2);
  for (const Space space : {Space::none, Space::dense}) {
    const FieldEnergy energy = make_energy(mesh, {2, space}, 2);
    ASSERT_GT(energy.table().num_points(), 4096);
    const Vector c = random_vector(energy.table().num_unknowns(), 0.005, 6);
    const Vector rate = random_vector(energy.table().num_unknowns(), 0.03, 7);
    use_threads();
    const auto run = [&](std::size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return energy.evaluate({c, {}, &rate});
    };
    const EnergyValue one = run(1);
    for (int repeat = 0; repeat < 3; ++repeat) {
      const EnergyValue two = run(2);
      EXPECT_EQ(one.value, two.value);
      EXPECT_EQ(one.min_det, two.min_det);
      EXPECT_TRUE(one.gradient == two.gradient);
    }
  }
}

}  // namespace
}  // namespace polyaffine
