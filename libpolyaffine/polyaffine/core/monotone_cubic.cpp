#include "polyaffine/core/monotone_cubic.hpp"

#include <algorithm>
#include <stdexcept>

namespace polyaffine {

MonotoneCubic::MonotoneCubic(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)) {
  const std::size_t n = x_.size();
  if (n < 2 || y_.size() != n) throw std::invalid_argument("monotone cubic: at least two points are needed");
  for (std::size_t k = 1; k < n; ++k)
    if (!(x_[k] > x_[k - 1])) throw std::invalid_argument("monotone cubic: x must ascend");
  std::vector<double> h(n - 1), d(n - 1);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    h[k] = x_[k + 1] - x_[k];
    d[k] = (y_[k + 1] - y_[k]) / h[k];
  }
  slope_.assign(n, 0.0);
  slope_.front() = d.front();
  slope_.back() = d.back();
  for (std::size_t k = 1; k + 1 < n; ++k)
    if (d[k - 1] * d[k] > 0) {
      const double w1 = 2 * h[k] + h[k - 1];
      const double w2 = h[k] + 2 * h[k - 1];
      slope_[k] = (w1 + w2) / (w1 / d[k - 1] + w2 / d[k]);
    }
}

bool MonotoneCubic::is_whole() const {
  const auto not_ascending = [](double a, double b) { return !(a < b); };
  return x_.size() >= 2 && y_.size() == x_.size() && slope_.size() == x_.size() &&
         std::adjacent_find(x_.begin(), x_.end(), not_ascending) == x_.end();
}

std::pair<double, double> MonotoneCubic::operator()(double x) const {
  if (x <= x_.front()) return {y_.front() + slope_.front() * (x - x_.front()), slope_.front()};
  if (x >= x_.back()) return {y_.back() + slope_.back() * (x - x_.back()), slope_.back()};
  const auto k = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin()) - 1;
  const double h = x_[k + 1] - x_[k];
  const double s = (x - x_[k]) / h;
  const double a = slope_[k] * h;
  const double b = slope_[k + 1] * h;
  const double dy = y_[k + 1] - y_[k];
  const double c2 = 3 * dy - 2 * a - b;
  const double c3 = a + b - 2 * dy;
  return {y_[k] + s * (a + s * (c2 + s * c3)), (a + s * (2 * c2 + 3 * s * c3)) / h};
}

}  // namespace polyaffine
