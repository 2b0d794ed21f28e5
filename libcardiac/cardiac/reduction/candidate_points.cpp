#include "cardiac/reduction/candidate_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include <polyaffine/rules/split_rule.hpp>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::Vec3;
using polyaffine::Vec4;
using FaceCorners = polyaffine::LagrangeBasis::FaceCorners;

namespace {

// Degree of the Gauss points of an element that no border crosses, and of a part of one that is crossed.
constexpr int kCandidateDegree = 4, kPartDegree = 2;
// How often a crossed element is cut into eight (a face into four). Without cuts the volumes of cells are
// wrong by parts of elements, and so, which matters more, are the areas that a pressure pushes on.
constexpr int kWallCuts = 1, kSurfaceCuts = 2;
// The corners of an element are asked for their cell this share of the way to its middle:
//
//      border ──┬──────      The corner on the border belongs to the cell of the element's inside, so an
//              ╱·╲           element that only touches a border is not crossed by it, and rounding does not
//             ╱   ╲          decide.
constexpr double kDrawnIn = 1e-3;

// The corners (columns, barycentric in a tet) in an order that belongs to the heart, not to the file: by
// their place along a line oblique to its axes, of which 0.618 and 0.382 (the golden section) make equal
// places unlikely.
template <class Corners>
Corners in_order_of_heart(const VentricularCoordinates& heart, int tet, const Corners& corners) {
  const Vec3 along = heart.axis() + 0.618 * heart.anterior() + 0.382 * heart.axis().cross(heart.anterior());
  std::vector<std::pair<double, Eigen::Index>> order;
  for (Eigen::Index k = 0; k < corners.cols(); ++k)
    order.emplace_back(along.dot(heart.position(tet, corners.col(k))), k);
  std::ranges::sort(order);
  Corners out = corners;
  for (std::size_t k = 0; k < order.size(); ++k)
    out.col(static_cast<Eigen::Index>(k)) = corners.col(order[k].second);
  return out;
}

// Whether the corners (columns, barycentric in the tet), drawn in a little, lie in different cells.
template <class Corners>
bool is_crossed(const SegmentCells& cells, int tet, const Corners& corners) {
  const Vec4 middle = corners.rowwise().mean();
  const auto cell = [&](Eigen::Index k) {
    const Vec4 inside = (1 - kDrawnIn) * corners.col(k) + kDrawnIn * middle;
    return cells(tet, inside).cell;
  };
  const int first = cell(0);
  for (Eigen::Index k = 1; k < corners.cols(); ++k)
    if (cell(k) != first) return true;
  return false;
}

polyaffine::TetRule split_tet(const VentricularCoordinates& heart, const SegmentCells& cells, int tet,
                              const polyaffine::TetRule& whole, const polyaffine::TetRule& part) {
  const Eigen::Matrix4d in_order = in_order_of_heart(heart, tet, Eigen::Matrix4d::Identity().eval());
  const auto crossed = [&](const Eigen::Matrix4d& corners) {
    return is_crossed(cells, tet, (in_order * corners).eval());
  };
  polyaffine::TetRule rule = polyaffine::split_rule(whole, part, crossed, kWallCuts);
  rule.barycentric = (in_order * rule.barycentric).eval();
  return rule;
}

polyaffine::TriangleRule split_face(const VentricularCoordinates& heart, const SegmentCells& cells, int tet,
                                    const FaceCorners& face, const polyaffine::TriangleRule& whole,
                                    const polyaffine::TriangleRule& part) {
  const FaceCorners in_order = in_order_of_heart(heart, tet, face);
  const auto crossed = [&](const Mat3& corners) {
    return is_crossed(cells, tet, (in_order * corners).eval());
  };
  polyaffine::TriangleRule rule = polyaffine::split_rule(whole, part, crossed, kSurfaceCuts);
  // The columns of `face` are unit vectors, so its transpose leads from the tet back to the face.
  const Mat3 order = face.transpose() * in_order;
  rule.barycentric = (order * rule.barycentric).eval();
  return rule;
}

}  // namespace

CandidatePoints plain_candidates(const polyaffine::LagrangeBasis& geometry) {
  return {geometry.wall_points(kCandidateDegree),
          [rule = polyaffine::triangle_rule(kCandidateDegree)](int, const FaceCorners&) { return rule; }};
}

CandidatePoints split_candidates(const VentricularCoordinates& heart, const SegmentCells& cells) {
  const auto wall = [&, whole = polyaffine::tet_rule(kCandidateDegree),
                     part = polyaffine::tet_rule(kPartDegree)](int tet) {
    return split_tet(heart, cells, tet, whole, part);
  };
  const auto face = [&heart, cells, whole = polyaffine::triangle_rule(kCandidateDegree),
                     part = polyaffine::triangle_rule(kPartDegree)](int tet, const FaceCorners& corners) {
    return split_face(heart, cells, tet, corners, whole, part);
  };
  return {heart.space().wall_points(wall), face};
}

}  // namespace cardiac
