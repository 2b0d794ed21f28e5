#include "cardiac/reduction/point_counts.hpp"

#include <algorithm>
#include <array>

namespace cardiac {
namespace {

// Fibres turn by about 140° through the depth, so every cell has at least this many Gauss points there and
// keeps polynomials at least up to this degree exact. With three points the fast preset is 5.5 % of
// displacement off at end systole on a healthy ventricle, with four 2.8 %.
constexpr int kDepthPoints = 4, kDepthDegree = 8;
// At the axis, where all three directions are alike, three points do around it and through the depth, but not
// outwards, where the tents of the cap and of the first ring meet.
constexpr int kApexPoints = 3;

// Highest power of the frames' functions along, around and through the wall, whatever the axes of their
// coefficients; at least 1. The cap is left out: its functions, of degree two at most, lie in cells with
// counts of their own (wall_at_apex).
std::array<int, 3> highest_powers(const polyaffine::FrameBasis& basis, int cap) {
  std::array<int, 3> out{1, 1, 1};
  for (std::size_t i = 0; i < basis.frames().size(); ++i) {
    if (static_cast<int>(i) == cap) continue;
    for (const polyaffine::Monomial& m : basis.frames()[i].monomials)
      for (int k = 0; k < 3; ++k) out[k] = std::max(out[k], m[k]);
  }
  return out;
}

}  // namespace

PointCounts point_counts(const polyaffine::FrameBasis& basis, const FrameLayout& layout, bool sigmoid) {
  const auto [along, around, through] = highest_powers(basis, layout.cap());
  // More rings than AHA's lessen the error along the wall. What the points add to it must shrink with it: one
  // more point at the axis, where the cells stay as thick as they are, and one more on surfaces.
  const bool more_rings = std::ssize(layout.rings) > kAhaRings;
  // Functions of higher degree let the wall bend within a cell.
  const bool bends = along > 1 || around > 1;

  PointCounts out;
  out.wall = {along + 1, around + 1, std::max(kDepthPoints, through + 1)};
  // The wall bends most at the axis, where along, around and through mean the same.
  const int depth = std::max(more_rings ? kApexPoints + 1 : kApexPoints, through + 1);
  out.wall_at_apex = {std::max(kDepthPoints, depth), depth, depth};
  // No other point makes up for the error of a point on a surface, so there is one more where the wall bends.
  const int surface = bends || more_rings ? 3 : 2, surface_at_apex = bends ? depth + 1 : depth;
  out.surface = {surface, surface, 1};
  out.surface_at_apex = {surface_at_apex, surface_at_apex, 1};
  // A power n times a linear weight, squared, has the degree 2 (n + 1); sigmoid weights bend, for which two
  // degrees more are kept.
  const int exact = 2 * std::max(along, around) + (sigmoid ? 4 : 2);
  out.exact = {exact, exact, std::max(kDepthDegree, 2 * through + 2)};
  return out;
}

}  // namespace cardiac
