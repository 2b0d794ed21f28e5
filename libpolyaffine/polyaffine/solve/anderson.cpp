#include "polyaffine/solve/anderson.hpp"

#include <Eigen/QR>

namespace polyaffine {

Vector Anderson::step(const Vector& x, const Vector& f) {
  x_.push_back(x);
  f_.push_back(f);
  if (x_.size() > memory_ + 1) {
    x_.pop_front();
    f_.pop_front();
  }
  const std::size_t differences = x_.size() - 1;
  if (differences == 0) return f;
  const auto m = static_cast<Eigen::Index>(differences);
  Matrix dx(x.size(), m), df(x.size(), m);
  for (std::size_t k = 0; k < differences; ++k) {
    dx.col(static_cast<Eigen::Index>(k)) = x_[k + 1] - x_[k];
    df.col(static_cast<Eigen::Index>(k)) = f_[k + 1] - f_[k];
  }
  Eigen::ColPivHouseholderQR<Matrix> least_squares(df);
  least_squares.setThreshold(1e-6);
  return f - (dx + df) * least_squares.solve(f);
}

void Anderson::forget() {
  x_.clear();
  f_.clear();
}

}  // namespace polyaffine
