#include "cardiac/validation/oscillation.hpp"

#include <Eigen/QR>
#include <cmath>
#include <stdexcept>

namespace cardiac {

double oscillation(const polyaffine::Vector& s, const polyaffine::Vector& y, double wavelength, int degree) {
  const Eigen::Index n = s.size();
  if (y.size() != n) throw std::invalid_argument("oscillation: a value for each place is needed");
  if (!(wavelength > 0)) throw std::invalid_argument("oscillation: the wavelength must be positive");
  if (degree < 0 || n < degree + 3) throw std::invalid_argument("oscillation: more points are needed");
  const Eigen::ArrayXd x = 2 * (s.array() - s.minCoeff()) / (s.maxCoeff() - s.minCoeff()) - 1;
  polyaffine::Matrix fit(n, degree + 3);
  fit.col(0).setOnes();
  if (degree > 0) fit.col(1) = x;
  for (int k = 1; k < degree; ++k)
    fit.col(k + 1) =
        ((2 * k + 1) * x * fit.col(k).array() - k * fit.col(k - 1).array()) / static_cast<double>(k + 1);
  const Eigen::ArrayXd phase = 2 * polyaffine::kPi * s.array() / wavelength;
  fit.col(degree + 1) = phase.cos();
  fit.col(degree + 2) = phase.sin();
  const polyaffine::Vector c = fit.colPivHouseholderQr().solve(y);
  return std::hypot(c[degree + 1], c[degree + 2]);
}

}  // namespace cardiac
