#include "polyaffine/mesh/triangle_adjacency.hpp"

#include <algorithm>
#include <tuple>

namespace polyaffine {
namespace {

struct HalfEdge {
  int low, high, triangle, local;
};

}  // namespace

TriangleAdjacency triangle_adjacency(const Triangles& triangles) {
  std::vector<HalfEdge> edges;
  edges.reserve(triangles.size());
  for (int t = 0; t < static_cast<int>(triangles.cols()); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles(k, t), triangles((k + 1) % 3, t));
      edges.push_back({low, high, t, k});
    }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.triangle, a.local) < std::tie(b.low, b.high, b.triangle, b.local);
  });
  TriangleAdjacency out;
  out.across = Triangles::Constant(3, triangles.cols(), -1);
  for (std::size_t e = 0; e < edges.size();) {
    std::size_t end = e + 1;
    while (end < edges.size() && edges[end].low == edges[e].low && edges[end].high == edges[e].high) ++end;
    const std::array<int, 2> edge{edges[e].low, edges[e].high};
    if (end - e == 1) {
      out.open.push_back(edge);
    } else if (end - e > 2) {
      out.crowded.push_back(edge);
    } else {
      const HalfEdge &a = edges[e], &b = edges[e + 1];
      out.across(a.local, a.triangle) = b.triangle;
      out.across(b.local, b.triangle) = a.triangle;
      if (triangles(a.local, a.triangle) == triangles(b.local, b.triangle)) out.opposed.push_back(edge);
    }
    e = end;
  }
  return out;
}

int pinched_vertex(const Triangles& triangles, const Triangles& across) {
  if (triangles.cols() == 0) return -1;
  std::vector<int> valence(triangles.maxCoeff() + 1, 0), seen(valence.size(), 0);
  for (const int v : triangles.reshaped()) ++valence[v];
  for (int t = 0; t < static_cast<int>(triangles.cols()); ++t)
    for (int k = 0; k < 3; ++k) {
      const int v = triangles(k, t);
      if (seen[v]) continue;
      int at = t;
      do {
        ++seen[v];
        // Around v: across the edge that arrives at v.
        const int local = static_cast<int>(std::find(triangles.col(at).begin(), triangles.col(at).end(), v) -
                                           triangles.col(at).begin());
        at = across((local + 2) % 3, at);
      } while (at != t && at >= 0 && seen[v] <= valence[v]);
      if (seen[v] != valence[v]) return v;
    }
  return -1;
}

}  // namespace polyaffine
