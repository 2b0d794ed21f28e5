#include "polyaffine/linear/projection.hpp"

#include <Eigen/QR>
#include <cmath>
#include <string>
#include <utility>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

class ProjectedSystem : public LinearSystem {
 public:
  explicit ProjectedSystem(std::shared_ptr<const Projection> projection)
      : projection_(std::move(projection)),
        K_(projection_->Z.rows(), projection_->Z.rows()),
        reduced_(dense_system(projection_->num_free())) {}

  void set_zero() override { K_.setZero(); }
  void add(const std::vector<int>& functions, const Matrix& K) override {
    for (std::size_t b = 0; b < functions.size(); ++b)
      for (std::size_t a = 0; a < functions.size(); ++a)
        K_.block<3, 3>(3 * functions[a], 3 * functions[b]) +=
            K.block<3, 3>(3 * static_cast<Eigen::Index>(a), 3 * static_cast<Eigen::Index>(b));
  }
  void add_dense(const Matrix& K) override { K_ += K; }
  bool factorise() override {
    reduced_->set_zero();
    reduced_->add_dense(projection_->Z.transpose() * K_ * projection_->Z);
    return reduced_->factorise();
  }
  Matrix solve(const Matrix& rhs) const override {
    return projection_->Z * reduced_->solve(projection_->Z.transpose() * rhs);
  }
  bool positive_definite() const override { return reduced_->positive_definite(); }

 private:
  std::shared_ptr<const Projection> projection_;
  Matrix K_;
  std::unique_ptr<LinearSystem> reduced_;
};

}  // namespace

LinearConstraints displacement_constraints(const Basis& basis, const std::vector<int>& tet,
                                           const Eigen::Matrix4Xd& barycentric, const Points& u) {
  LinearConstraints out{Matrix::Zero(u.size(), 3 * basis.num_functions()), u.reshaped()};
  for (Eigen::Index p = 0; p < u.cols(); ++p) {
    const BasisSample s = basis.sample(tet[p], barycentric.col(p));
    for (std::size_t k = 0; k < s.functions.size(); ++k) {
      const int a = s.functions[k];
      const Mat3 axes = basis.in_local_axes(a) ? s.Q : Mat3::Identity();
      out.C.block<3, 3>(3 * p, 3 * a) = s.N[static_cast<Eigen::Index>(k)] * axes;
    }
  }
  return out;
}

Projection project(const LinearConstraints& constraints, double tolerance) {
  const auto& [C, d] = constraints;
  if (C.rows() != d.size())
    throw InputError("constraints: found " + std::to_string(C.rows()) + " rows and " +
                     std::to_string(d.size()) + " values, expected as many");
  if (!C.allFinite() || !d.allFinite()) throw InputError("constraints: found a number that is not finite");
  const Eigen::Index n = C.cols();
  Projection out;
  if (C.rows() == 0) {
    out.c0 = Vector::Zero(n);
    out.Z = Matrix::Identity(n, n);
    return out;
  }
  Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition;
  decomposition.setThreshold(tolerance);
  decomposition.compute(C);
  out.rank = static_cast<int>(decomposition.rank());
  out.c0 = decomposition.solve(d);
  out.residual = d.norm() > 0 ? (C * out.c0 - d).norm() / d.norm() : 0;
  if (out.residual > std::sqrt(tolerance))
    throw InputError("constraints: they contradict each other: the best compromise misses the " +
                     std::to_string(d.size()) + " prescribed values (" + std::to_string(out.rank) +
                     " independent) by " + std::to_string(100 * out.residual) + " percent of their norm");
  out.Z = Matrix(n, 0);
  if (out.rank < n)
    out.Z = decomposition.colsPermutation() * decomposition.matrixZ().transpose().rightCols(n - out.rank);
  return out;
}

std::unique_ptr<LinearSystem> projected_system(std::shared_ptr<const Projection> projection) {
  return std::make_unique<ProjectedSystem>(std::move(projection));
}

}  // namespace polyaffine
