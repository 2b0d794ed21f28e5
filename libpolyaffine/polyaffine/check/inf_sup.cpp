#include "polyaffine/check/inf_sup.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <polyaffine/core/error.hpp>
#include <polyaffine/kinematics/block_products.hpp>

namespace polyaffine {
namespace {

// ∂(ε : ε)/2 twice by F: A_iJkL = ½ (δ_ik δ_JL + δ_iL δ_kJ), times the weights of a pack.
PackResponse strain_product(const Pack& weight) {
  PackResponse r;
  clear(r, true);
  for (int a = 0; a < 9; ++a)
    for (int b = 0; b < 9; ++b) {
      const int i = a % 3, J = a / 3, k = b % 3, L = b / 3;
      const double entry = 0.5 * ((i == k && J == L) + (i == L && k == J));
      r.A[a][b] = entry * weight;
    }
  return r;
}

std::vector<int> unknowns_of(const std::vector<int>& functions) {
  std::vector<int> out;
  for (const int f : functions) out.insert(out.end(), {3 * f, 3 * f + 1, 3 * f + 2});
  return out;
}

}  // namespace

InfSup inf_sup(const FieldTable& table, const PressureSpace& space, const std::vector<char>& fixed) {
  Matrix A = Matrix::Zero(table.num_unknowns(), table.num_unknowns());
  Matrix D = Matrix::Zero(space.num_functions, table.num_unknowns());
  Matrix K, rows;
  for (std::size_t k = 0; k < table.blocks.size(); ++k) {
    const PackedBlock block(table.blocks[k], table);
    std::vector<PackResponse> strain;
    std::vector<Mat3Pack> divergence(block.num_packs());
    for (int p = 0; p < block.num_packs(); ++p) {
      strain.push_back(strain_product(block.weight(p)));
      for (int i = 0; i < 9; ++i) divergence[p].m[i] = (i % 4 == 0 ? 1.0 : 0.0) * block.weight(p);
    }
    const std::vector<int> unknowns = unknowns_of(block.functions());
    block_stiffness(block, strain.data(), K);
    A(unknowns, unknowns) += K;
    block_force_rows(block, divergence.data(), space.blocks[k].values, rows);
    D(space.blocks[k].functions, unknowns) += rows;
  }
  std::vector<int> free;
  for (int i = 0; i < table.num_unknowns(); ++i)
    if (fixed.empty() || !fixed[i]) free.push_back(i);
  const Eigen::LLT<Matrix> cholesky(A(free, free));
  if (cholesky.info() != Eigen::Success || cholesky.rcond() < 1e-15)
    throw ComputationError("inf-sup check: some motion has no strain at the integration points");
  const Matrix X = cholesky.matrixL().solve(D(Eigen::all, free).transpose());  // A^(−1/2) Dᵀ
  const Matrix S = X.transpose() * X;
  const Matrix inverse =
      InverseMass(space, table).apply(Matrix::Identity(space.num_functions, space.num_functions));
  const Matrix half = Eigen::LLT<Matrix>(inverse).matrixL();  // M⁻¹ = half halfᵀ
  const Vector squares =
      Eigen::SelfAdjointEigenSolver<Matrix>(half.transpose() * S * half, Eigen::EigenvaluesOnly)
          .eigenvalues();
  InfSup out{static_cast<int>(free.size()), space.num_functions, squares.cwiseMax(0).cwiseSqrt(), 0};
  for (const double s : out.singular_values)
    out.spurious += s < InfSup::kSpurious * out.singular_values.maxCoeff();
  return out;
}

}  // namespace polyaffine
