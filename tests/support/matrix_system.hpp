#pragma once

#include <stdexcept>
#include <vector>

#include <polyaffine/linear/linear_system.hpp>
#include <polyaffine/system/field_energy.hpp>

namespace polyaffine::testing {

/// Collects a tangent as one dense matrix that a test can look at; it solves nothing.
class MatrixSystem : public LinearSystem {
 public:
  explicit MatrixSystem(int num_unknowns) : K(Matrix::Zero(num_unknowns, num_unknowns)) {}
  void set_zero() override { K.setZero(); }
  void add(const std::vector<int>& functions, const Matrix& block) override {
    for (std::size_t a = 0; a < functions.size(); ++a)
      for (std::size_t b = 0; b < functions.size(); ++b)
        K.block<3, 3>(3 * functions[a], 3 * functions[b]) +=
            block.block<3, 3>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * b));
  }
  void add_dense(const Matrix& all) override { K += all; }
  bool factorise() override { return false; }
  Matrix solve(const Matrix&) const override { throw std::logic_error("this system only collects"); }
  bool positive_definite() const override { return false; }

  Matrix K;
};

inline Matrix tangent(const FieldEnergy& energy, const Motion& motion, double scale = 1,
                      double rate_factor = 0) {
  MatrixSystem system(energy.table().num_unknowns());
  energy.add_tangent(motion, system, scale, rate_factor);
  return system.K;
}

}  // namespace polyaffine::testing
