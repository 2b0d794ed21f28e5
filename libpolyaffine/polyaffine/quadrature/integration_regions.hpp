#pragma once

#include <random>
#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/geometry/eikonal.hpp>
#include <polyaffine/rules/gauss.hpp>

namespace polyaffine {

/// A division of control regions into integration regions with one point each.
struct IntegrationRegions {
  std::vector<int> label;    ///< integration region of each tet, −1 outside the control regions
  std::vector<int> control;  ///< control region of each integration region, ascending
  QuadraturePoints
      points;  ///< where the region comes closest to its centre of volume; weight: its volume, mm³
};

/// `total` numbers shared out in proportion to `volumes` by largest remainders (Hamilton), at least one and
/// at most `most[i]` each. Throws InputError when total is below the count or above the sum of `most`.
std::vector<int> share_out(int total, const Vector& volumes, const std::vector<int>& most);

/// Geodesic Voronoi regions with Lloyd relaxation inside every control region 0 … count − 1 of `control` (a
/// label a tet, −1: none); the number in each is proportional to its volume. The weights of a control region
/// sum to its volume whatever the seeds. Throws InputError when a control region has no tet or `total` does
/// not fit.
IntegrationRegions integration_regions(const EikonalSolver& solver, const std::vector<int>& control,
                                       int count, int total, std::mt19937_64& random,
                                       int lloyd_iterations = 10);

}  // namespace polyaffine
