#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "polyaffine/solve/linear_system.hpp"

namespace polyaffine {
namespace {

class DenseSystem : public LinearSystem {
 public:
  DenseSystem(int n, std::vector<char> fixed) : K_(n, n), fixed_(std::move(fixed)) { fixed_.resize(n, 0); }

  void set_zero() override { K_.setZero(); }

  void add(const std::vector<int>& functions, const Matrix& K) override {
    for (std::size_t b = 0; b < functions.size(); ++b)
      for (int j = 0; j < 3; ++j) {
        auto column = K_.col(3 * functions[b] + j);
        const auto local = K.col(static_cast<Eigen::Index>(3 * b + j));
        for (std::size_t a = 0; a < functions.size(); ++a)
          column.segment<3>(3 * functions[a]) += local.segment<3>(static_cast<Eigen::Index>(3 * a));
      }
  }

  void add_dense(const Matrix& K) override { K_ += K; }

  bool factorise() override {
    for (std::size_t i = 0; i < fixed_.size(); ++i)
      if (fixed_[i]) {
        const auto k = static_cast<Eigen::Index>(i);
        K_.row(k).setZero();
        K_.col(k).setZero();
        K_(k, k) = 1;
      }
    if (!K_.allFinite()) return false;
    cholesky_.compute(K_);
    positive_ = cholesky_.info() == Eigen::Success;
    if (positive_) return true;
    lu_.compute(K_);
    return lu_.rcond() > 1e-14;  // below this no digit of the solution is left
  }

  Matrix solve(const Matrix& rhs) const override {
    if (positive_) return cholesky_.solve(rhs);
    return lu_.solve(rhs);
  }

  bool positive_definite() const override { return positive_; }

 private:
  Matrix K_;
  std::vector<char> fixed_;
  Eigen::LLT<Matrix> cholesky_;
  Eigen::PartialPivLU<Matrix> lu_;
  bool positive_ = false;
};

}  // namespace

std::unique_ptr<LinearSystem> dense_system(int num_unknowns, const std::vector<char>& fixed) {
  return std::make_unique<DenseSystem>(num_unknowns, fixed);
}

}  // namespace polyaffine
