#include "polyaffine/rules/split_rule.hpp"

#include <array>
#include <vector>

namespace polyaffine {
namespace {

// Corners of the parts: 0 … n − 1 are those of the element, then the midpoints of the edges in this order.
template <int kCorners>
struct Parts;

template <>
struct Parts<3> {
  static constexpr std::array<std::array<int, 2>, 3> kEdges{{{0, 1}, {0, 2}, {1, 2}}};
  static constexpr std::array<std::array<int, 3>, 4> kCells{{{0, 3, 4}, {1, 5, 3}, {2, 4, 5}, {3, 5, 4}}};
};

template <>
struct Parts<4> {
  static constexpr std::array<std::array<int, 2>, 6> kEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  static constexpr std::array<std::array<int, 4>, 8> kCells{{{0, 4, 5, 6},
                                                             {1, 4, 7, 8},
                                                             {2, 5, 7, 9},
                                                             {3, 6, 8, 9},
                                                             {4, 9, 5, 6},
                                                             {4, 9, 6, 8},
                                                             {4, 9, 8, 7},
                                                             {4, 9, 7, 5}}};
};

template <int n>
using Corners = Eigen::Matrix<double, n, n>;

template <int n>
std::vector<Corners<n>> halves(const Corners<n>& corners) {
  std::vector<Eigen::Vector<double, n>> nodes;
  for (int k = 0; k < n; ++k) nodes.push_back(corners.col(k));
  for (const auto& [a, b] : Parts<n>::kEdges) nodes.push_back((nodes[a] + nodes[b]) / 2);
  std::vector<Corners<n>> out;
  for (const auto& cell : Parts<n>::kCells) {
    out.emplace_back();
    for (int k = 0; k < n; ++k) out.back().col(k) = nodes[cell[k]];
  }
  return out;
}

template <int n, class Rule>
Rule split(const Rule& whole, const Rule& part, const std::function<bool(const Corners<n>&)>& crossed,
           int levels) {
  const Corners<n> element = Corners<n>::Identity();
  if (levels < 1 || !crossed(element)) return whole;
  std::vector<Corners<n>> smooth, open{element};
  std::vector<double> share;
  double size = 1;
  for (int level = 1; level <= levels; ++level) {
    std::vector<Corners<n>> next;
    size /= static_cast<double>(Parts<n>::kCells.size());
    for (const Corners<n>& parent : open)
      for (const Corners<n>& child : halves<n>(parent)) {
        const bool again = level < levels && crossed(child);
        (again ? next : smooth).push_back(child);
        if (!again) share.push_back(size);
      }
    open = std::move(next);
  }
  const Eigen::Index points = part.weights.size();
  Rule out;
  out.barycentric.resize(n, points * std::ssize(smooth));
  out.weights.resize(points * std::ssize(smooth));
  for (std::size_t k = 0; k < smooth.size(); ++k) {
    const auto start = static_cast<Eigen::Index>(k) * points;
    out.barycentric.middleCols(start, points) = smooth[k] * part.barycentric;
    out.weights.segment(start, points) = share[k] * part.weights;
  }
  return out;
}

}  // namespace

TetRule split_rule(const TetRule& whole, const TetRule& part,
                   const std::function<bool(const Eigen::Matrix4d&)>& crossed, int levels) {
  return split<4>(whole, part, crossed, levels);
}

TriangleRule split_rule(const TriangleRule& whole, const TriangleRule& part,
                        const std::function<bool(const Mat3&)>& crossed, int levels) {
  return split<3>(whole, part, crossed, levels);
}

}  // namespace polyaffine
