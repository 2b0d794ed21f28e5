#include "polyaffine/linear/linear_system.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include <polyaffine/kinematics/lagrange.hpp>
#include <polyaffine/linear/sparse_system.hpp>

#include "support/labelled_box.hpp"
#include "support/matrix_system.hpp"
#include "support/random_vector.hpp"

namespace polyaffine {
namespace {

using testing::random_vector;

// Symmetric blocks over the elements of a small mesh; `shift` on their diagonals decides about definiteness.
struct Blocks {
  TetMesh mesh = testing::labelled_cube(2);
  LagrangeBasis basis{mesh, 1};
  FieldTable table = deformation_table(basis, basis.wall_points(1));

  void add(LinearSystem& system, double shift) const {
    unsigned seed = 1;
    for (const auto& block : table.blocks) {
      const Matrix B = random_vector(144, 1, seed++).reshaped(12, 12);
      const Matrix K = B * B.transpose() + shift * Matrix::Identity(12, 12);
      system.add(block.functions(), K);
    }
  }
  int unknowns() const { return table.num_unknowns(); }
};

class DenseAndSparse : public ::testing::TestWithParam<double> {};

TEST_P(DenseAndSparse, SolveTheSameSystem) {
  const Blocks blocks;
  std::vector<char> fixed(blocks.unknowns(), 0);
  for (const int i : {0, 7, 40}) fixed[i] = 1;
  const auto dense = dense_system(blocks.unknowns(), fixed);
  const auto sparse = sparse_system({&blocks.table}, fixed);
  testing::MatrixSystem exact(blocks.unknowns());
  blocks.add(exact, GetParam());
  for (int i = 0; i < blocks.unknowns(); ++i)
    if (fixed[i]) {
      exact.K.row(i).setZero();
      exact.K.col(i).setZero();
      exact.K(i, i) = 1;
    }
  Matrix rhs = random_vector(2 * blocks.unknowns(), 1, 99).reshaped(blocks.unknowns(), 2);
  for (const int i : {0, 7, 40}) rhs.row(i).setZero();

  const bool positive = GetParam() > 0;
  for (LinearSystem* system : {dense.get(), sparse.get()})
    for (int repeat = 0; repeat < 2; ++repeat) {  // the second time on the kept analysis
      system->set_zero();
      blocks.add(*system, GetParam());
      ASSERT_TRUE(system->factorise());
      EXPECT_EQ(system->positive_definite(), positive);
      const Matrix x = system->solve(rhs);
      // Rounding times a condition number of about 10³.
      EXPECT_LT((exact.K * x - rhs).norm(), 1e-11 * rhs.norm());
      for (const int i : {0, 7, 40}) EXPECT_EQ(x.row(i).norm(), 0);
    }
  EXPECT_LT((dense->solve(rhs) - sparse->solve(rhs)).norm(), 1e-10 * dense->solve(rhs).norm());
}

// Eigenvalues of B Bᵀ lie between 0 and about 20: the first is definite, the second is not.
INSTANTIATE_TEST_SUITE_P(Definiteness, DenseAndSparse, ::testing::Values(1.0, -6.0));

TEST(LinearSystem, SingularOrBrokenMatricesAreRefused) {
  const Blocks blocks;
  const auto dense = dense_system(blocks.unknowns());
  const auto sparse = sparse_system({&blocks.table});
  for (LinearSystem* system : {dense.get(), sparse.get()}) {
    system->set_zero();
    EXPECT_FALSE(system->factorise());
    blocks.add(*system, 1);
    EXPECT_TRUE(system->factorise());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    system->add(blocks.table.blocks.front().functions(), Matrix::Constant(12, 12, nan));
    EXPECT_FALSE(system->factorise());
    system->set_zero();  // and recovers
    blocks.add(*system, 1);
    EXPECT_TRUE(system->factorise());
  }
}

// Functions that slide in a plane: the solution is that of P K P + n nᵀ.
TEST_P(DenseAndSparse, HoldDirections) {
  const Blocks blocks;
  const HeldDirections held{
      {3, Vec3(1, 2, -1).normalized()}, {4, Vec3(0, 1, 1).normalized()}, {20, Vec3::UnitX()}};
  testing::MatrixSystem exact(blocks.unknowns());
  blocks.add(exact, GetParam());
  Matrix P = Matrix::Identity(blocks.unknowns(), blocks.unknowns());
  for (const HeldDirection& h : held) P.block<3, 3>(3 * h.function, 3 * h.function) = h.free();
  const Matrix K = P * exact.K * P + Matrix::Identity(P.rows(), P.cols()) - P;
  const Vector rhs = P * random_vector(blocks.unknowns(), 1, 98);
  const auto dense = dense_system(blocks.unknowns(), {}, held);
  const auto sparse = sparse_system({&blocks.table}, {}, false, held);
  for (LinearSystem* system : {dense.get(), sparse.get()}) {
    system->set_zero();
    blocks.add(*system, GetParam());
    ASSERT_TRUE(system->factorise());
    const Vector x = system->solve(rhs);
    EXPECT_LT((K * x - rhs).norm(), 1e-11 * rhs.norm());
    for (const HeldDirection& h : held)
      EXPECT_LT(std::abs(h.direction.dot(x.segment<3>(3 * h.function))), 1e-13 * x.norm());
  }
}

// Two stiff springs to the ground and one between them that is softer by far; then without those to the
// ground.
TEST(LinearSystem, NearlySingularIsRefusedAndBadlyScaledIsNot) {
  const auto pair = [](double ground, double between) {
    Matrix K = Matrix::Identity(6, 6);
    K(0, 0) = ground + between;
    K(3, 3) = between;
    K(3, 0) = K(0, 3) = -between;
    return K;
  };
  const auto system = dense_system(6);
  system->set_zero();
  system->add_dense(pair(1e-15, 1));
  EXPECT_FALSE(system->factorise());
  system->set_zero();
  system->add_dense(pair(1e12, 1e-12));
  EXPECT_TRUE(system->factorise());
}

TEST(LinearSystem, OnlyDenseStorageTakesAFullMatrix) {
  const Blocks blocks;
  const Matrix one = Matrix::Identity(blocks.unknowns(), blocks.unknowns());
  const auto dense = dense_system(blocks.unknowns());
  dense->set_zero();
  dense->add_dense(4 * one);
  ASSERT_TRUE(dense->factorise());
  EXPECT_LT((dense->solve(one) - 0.25 * one).norm(), 1e-14);
  const Matrix X = Matrix::Constant(2, blocks.unknowns(), 0.5);
  const Matrix sum = 4 * one + 3 * X.transpose() * X;
  dense->set_zero();
  dense->add_dense(4 * one);
  dense->add_gram(X, 3);
  ASSERT_TRUE(dense->factorise());
  EXPECT_LT((sum * dense->solve(one) - one).norm(), 1e-13);
  EXPECT_THROW(sparse_system({&blocks.table})->add_dense(one), std::logic_error);
}

}  // namespace
}  // namespace polyaffine
