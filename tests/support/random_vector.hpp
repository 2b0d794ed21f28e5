#pragma once

#include <random>

#include <polyaffine/core/types.hpp>

namespace polyaffine::testing {

/// Numbers in [−amplitude, amplitude], the same in every run.
inline Vector random_vector(Eigen::Index size, double amplitude, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  Vector out(size);
  for (double& x : out) x = uniform(random);
  return out;
}

}  // namespace polyaffine::testing
