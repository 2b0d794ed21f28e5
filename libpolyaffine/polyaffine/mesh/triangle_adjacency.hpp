#pragma once

#include <array>
#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// How the triangles of a surface hang together.
struct TriangleAdjacency {
  Triangles across;  ///< triangle across the edge from vertex k to k + 1, −1 where there is none or several
  std::vector<std::array<int, 2>> open;     ///< edges of one triangle (two vertices)
  std::vector<std::array<int, 2>> crowded;  ///< edges of more than two triangles
  std::vector<std::array<int, 2>> opposed;  ///< edges that two triangles pass in the same direction
};

/// Edges are found by sorting: n log n in the number of triangles.
TriangleAdjacency triangle_adjacency(const Triangles& triangles);

/// Number (from 0) of the edge-connected part of each triangle; edges where `joined(triangle, k)` is false
/// separate.
template <class Joined>
std::vector<int> connected_parts(const Triangles& across, const Joined& joined) {
  std::vector<int> part(across.cols(), -1), front;
  int count = 0;
  for (int first = 0; first < static_cast<int>(across.cols()); ++first) {
    if (part[first] >= 0) continue;
    part[first] = count;
    front.push_back(first);
    while (!front.empty()) {
      const int t = front.back();
      front.pop_back();
      for (int k = 0; k < 3; ++k) {
        const int n = across(k, t);
        if (n < 0 || part[n] >= 0 || !joined(t, k)) continue;
        part[n] = count;
        front.push_back(n);
      }
    }
    ++count;
  }
  return part;
}

/// A vertex at which triangles meet that are not neighbours of one another around it (a surface that touches
/// itself in a point), −1 where there is none. The surface is closed and oriented, no edge is
/// crowded.
int pinched_vertex(const Triangles& triangles, const Triangles& across);

}  // namespace polyaffine
