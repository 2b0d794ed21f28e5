#pragma once

#include <functional>

#include <polyaffine/rules/gauss.hpp>

namespace polyaffine {

/// A rule for what is smooth on both sides of borders but has kinks or jumps across them: `whole` in an
/// element that no border crosses; else `part` in each of the eight (four) equal parts between its corners
/// and the midpoints of its edges (Bey 1995), where a part that a border crosses is cut again, up to `levels`
/// times in all. `crossed` is told the corners (columns, barycentric in the element) of the element or part.
TetRule split_rule(const TetRule& whole, const TetRule& part,
                   const std::function<bool(const Eigen::Matrix4d& corners)>& crossed, int levels);
TriangleRule split_rule(const TriangleRule& whole, const TriangleRule& part,
                        const std::function<bool(const Mat3& corners)>& crossed, int levels);

}  // namespace polyaffine
