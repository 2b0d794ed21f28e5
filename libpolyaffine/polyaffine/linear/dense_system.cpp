#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <optional>

#include "polyaffine/linear/linear_system.hpp"

namespace polyaffine {
namespace {

class DenseSystem : public LinearSystem {
 public:
  DenseSystem(int n, std::vector<char> fixed, HeldDirections held)
      : K_(Matrix::Zero(n, n)), fixed_(std::move(fixed)), held_(std::move(held)) {
    fixed_.resize(n, 0);
  }

  // Only the lower triangle is kept.
  void set_zero() override { K_.triangularView<Eigen::Lower>().setZero(); }

  void add(const std::vector<int>& functions, const Matrix& K) override {
    for (std::size_t b = 0; b < functions.size(); ++b)
      for (int j = 0; j < 3; ++j) {
        double* column = K_.col(3 * functions[b] + j).data();
        const double* local = K.col(static_cast<Eigen::Index>(3 * b + j)).data();
        for (const int a : functions) {
          if (a >= functions[b])
            for (int i = 0; i < 3; ++i) column[3 * a + i] += local[i];
          local += 3;
        }
      }
  }

  void add_dense(const Matrix& K) override { K_.triangularView<Eigen::Lower>() += K; }

  void add_gram(const Matrix& X, double factor) override {
    K_.selfadjointView<Eigen::Lower>().rankUpdate(X.transpose(), factor);
  }

  bool factorise() override {
    for (const HeldDirection& h : held_) hold(h);
    for (std::size_t i = 0; i < fixed_.size(); ++i)
      if (fixed_[i]) {
        const auto k = static_cast<Eigen::Index>(i);
        K_.row(k).setZero();
        K_.col(k).setZero();
        K_(k, k) = 1;
      }
    lu_.reset();
    cholesky_.compute(K_);
    positive_ = cholesky_.info() == Eigen::Success;
    if (positive_) return cholesky_.matrixLLT().diagonal().allFinite() && smallest_pivot() > 1e-13;
    if (!K_.allFinite()) return false;
    lu_.emplace(Matrix(K_.selfadjointView<Eigen::Lower>()));
    return lu_->rcond() > 1e-14;  // below this no digit of the solution is left
  }

  Matrix solve(const Matrix& rhs) const override {
    if (!positive_) return lu_->solve(rhs);
    if (rhs.cols() > 1) return cholesky_.solve(rhs);
    Vector x = rhs;  // for one vector the substitution of a matrix spends its time on copies of the factor
    cholesky_.matrixL().solveInPlace(x);
    cholesky_.matrixU().solveInPlace(x);
    return x;
  }

  bool positive_definite() const override { return positive_; }

 private:
  // P K P + n nᵀ in the rows and columns of a function, of the lower triangle.
  void hold(const HeldDirection& h) {
    const Eigen::Index first = 3 * static_cast<Eigen::Index>(h.function), after = first + 3;
    const Mat3 P = h.free();
    const Mat3 own = K_.block<3, 3>(first, first).selfadjointView<Eigen::Lower>();
    K_.block(first, 0, 3, first) = (P * K_.block(first, 0, 3, first)).eval();
    K_.block(after, first, K_.rows() - after, 3) = (K_.block(after, first, K_.rows() - after, 3) * P).eval();
    K_.block<3, 3>(first, first) = P * own * P + h.direction * h.direction.transpose();
  }

  // Of what the elimination leaves of the diagonal, as a share of it: independent of the units of the
  // unknowns.
  double smallest_pivot() const {
    return (cholesky_.matrixLLT().diagonal().array().square() / K_.diagonal().array()).minCoeff();
  }

  Matrix K_;
  std::vector<char> fixed_;
  HeldDirections held_;
  Eigen::LLT<Matrix> cholesky_;
  std::optional<Eigen::PartialPivLU<Matrix>> lu_;
  bool positive_ = false;
};

}  // namespace

std::unique_ptr<LinearSystem> dense_system(int num_unknowns, const std::vector<char>& fixed,
                                           const HeldDirections& held) {
  return std::make_unique<DenseSystem>(num_unknowns, fixed, held);
}

}  // namespace polyaffine
