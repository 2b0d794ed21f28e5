#pragma once

#include <polyaffine/core/archive_access.hpp>
#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// A smooth field over a region of space: the polynomial of total degree n in x, y, z (Legendre products over
/// the bounding box of the points) that is closest to given values, min Σ_q w_q |f(X_q) − f_q|². It keeps
/// what varies over the region and drops the noise of a mesh, and its gradient is exact.
class PolynomialField {
 public:
  static constexpr int kMostDegree = 8;
  /// X (3 × points, mm), values (components × points), weights ≥ 0, 0 ≤ degree ≤ kMostDegree. Throws
  /// InputError when the sizes differ, there are fewer points than functions, or the points have no extent
  /// along x, y or z.
  PolynomialField(const Points& X, const Matrix& values, const Vector& weights, int degree);

  struct Sample {
    Vector value;     ///< by component
    Matrix gradient;  ///< ∂f_i/∂X_J, components × 3, 1/mm
  };
  Sample sample(const Vec3& X) const;
  int num_functions() const { return static_cast<int>(coefficients_.cols()); }
  int num_components() const { return static_cast<int>(coefficients_.rows()); }

 private:
  friend class ArchiveAccess;
  PolynomialField() = default;
  template <class Archive>
  void archive(Archive& a) {
    a(degree_, centre_, half_, coefficients_);
    if constexpr (Archive::kReading)
      if (!is_whole()) a.refuse("found a polynomial whose coefficients do not fit its degree");
  }
  bool is_whole() const;

  static constexpr int kMost = (kMostDegree + 1) * (kMostDegree + 2) * (kMostDegree + 3) / 6;
  /// A column a function: its value and its gradient.
  using Functions = Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, kMost>;
  Functions functions(const Vec3& X) const;

  int degree_ = 0;
  Vec3 centre_, half_;
  Matrix coefficients_;  // components × functions
};

}  // namespace polyaffine
