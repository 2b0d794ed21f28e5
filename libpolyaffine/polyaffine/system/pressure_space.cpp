#include "polyaffine/system/pressure_space.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include <polyaffine/core/error.hpp>

namespace polyaffine {

namespace {

bool every_function_in_one_block(const PressureSpace& space) {
  std::vector<char> seen(space.num_functions, 0);
  for (const auto& block : space.blocks)
    for (const int b : block.functions)
      if (seen[b]++) return false;
  return true;
}

// L⁻¹ of M = LLᵀ.
Matrix inverse_factor(const Matrix& M) {
  const Eigen::LLT<Matrix> cholesky(M);
  if (cholesky.info() != Eigen::Success || cholesky.rcond() < 1e-13)
    throw ComputationError(
        "pressure space: its mass matrix is singular; a pressure function has no integration points "
        "or depends on others");
  return cholesky.matrixL().solve(Matrix::Identity(M.rows(), M.cols()));
}

Matrix inverse(const Matrix& M) {
  const Matrix half = inverse_factor(M);
  return half.transpose() * half;
}

}  // namespace

Vector dilatation(const PressureSpace& space, const FieldTable& table, const Vector& J) {
  Vector g = Vector::Zero(space.num_functions);
  for (std::size_t k = 0; k < table.blocks.size(); ++k) {
    const auto& block = table.blocks[k];
    const Vector change = table.weights.segment(block.first, block.count).array() *
                          (J.segment(block.first, block.count).array() - 1);
    g(space.blocks[k].functions) += space.blocks[k].values * change;
  }
  return g;
}

Vector pressure_mass(const PressureSpace& space, const FieldTable& table, const Vector& p) {
  if (space.mass.size() > 0) return space.mass * p;
  Vector out = Vector::Zero(space.num_functions);
  for (std::size_t k = 0; k < table.blocks.size(); ++k) {
    const auto& [functions, values] = space.blocks[k];
    const auto w = table.weights.segment(table.blocks[k].first, table.blocks[k].count);
    if (functions.size() == 1) {
      out[functions[0]] += p[functions[0]] * values.row(0).cwiseAbs2().dot(w);
      continue;
    }
    const Vector at_points = w.array() * (values.transpose() * p(functions)).array();
    out(functions) += values * at_points;
  }
  return out;
}

InverseMass::InverseMass(const PressureSpace& space, const FieldTable& table)
    : local_(space.mass.size() == 0 && every_function_in_one_block(space)) {
  if (space.mass.size() > 0) {
    half_ = inverse_factor(space.mass);
    dense_ = half_.transpose() * half_;
    return;
  }
  if (!local_) dense_ = Matrix::Zero(space.num_functions, space.num_functions);
  for (std::size_t k = 0; k < space.blocks.size(); ++k) {
    const auto& block = space.blocks[k];
    const auto w = table.weights.segment(table.blocks[k].first, table.blocks[k].count);
    const Matrix M = block.values * w.asDiagonal() * block.values.transpose();
    if (local_) {
      functions_.push_back(block.functions);
      blocks_.push_back(inverse(M));
    } else {
      dense_(block.functions, block.functions) += M;
    }
  }
  if (local_) return;
  half_ = inverse_factor(dense_);
  dense_ = half_.transpose() * half_;
}

Matrix InverseMass::apply(const Matrix& x) const {
  if (!local_) return dense_ * x;
  Matrix out(x.rows(), x.cols());
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    if (functions_[k].size() == 1)
      out.row(functions_[k][0]) = blocks_[k](0, 0) * x.row(functions_[k][0]);
    else
      out(functions_[k], Eigen::all) = blocks_[k] * x(functions_[k], Eigen::all);
  return out;
}

PressureSpace block_pressure(const FieldTable& table, double bulk_modulus, bool incompressible) {
  PressureSpace space{bulk_modulus, incompressible, static_cast<int>(table.blocks.size()), {}};
  for (int k = 0; k < space.num_functions; ++k)
    space.blocks.push_back({{k}, Matrix::Ones(1, table.blocks[k].count)});
  return space;
}

PressureSpace region_pressure(const FieldTable& table, const std::vector<int>& region, int num_regions,
                              double bulk_modulus) {
  PressureSpace space{bulk_modulus, false, num_regions, {}};
  for (const auto& block : table.blocks) {
    std::vector<int> present(region.begin() + block.first, region.begin() + block.first + block.count);
    std::sort(present.begin(), present.end());
    present.erase(std::unique(present.begin(), present.end()), present.end());
    Matrix values = Matrix::Zero(static_cast<Eigen::Index>(present.size()), block.count);
    for (int q = 0; q < block.count; ++q)
      values(std::lower_bound(present.begin(), present.end(), region[block.first + q]) - present.begin(), q) =
          1;
    space.blocks.push_back({present, values});
  }
  return space;
}

PressureSpace dense_pressure(const FieldTable& table, const Matrix& values, double bulk_modulus) {
  PressureSpace space{bulk_modulus, false, static_cast<int>(values.rows()), {}};
  for (const auto& block : table.blocks) {
    const auto here = values.middleCols(block.first, block.count);
    std::vector<int> present;
    for (int b = 0; b < space.num_functions; ++b)
      if (!here.row(b).isZero(0)) present.push_back(b);
    space.blocks.push_back({present, here(present, Eigen::all)});
  }
  return space;
}

}  // namespace polyaffine
