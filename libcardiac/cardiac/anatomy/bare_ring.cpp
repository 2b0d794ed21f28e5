#include "cardiac/anatomy/bare_ring.hpp"

#include <map>
#include <set>
#include <sstream>

#include <cardiac/anatomy/idealised.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/triangle_adjacency.hpp>

namespace cardiac {
namespace {

double length_of(const Points& points, const RingEdges& edges) {
  double sum = 0;
  for (const auto& [a, b] : edges) sum += (points.col(a) - points.col(b)).norm();
  return sum;
}

/// The edges that hang together.
std::vector<RingEdges> runs(const RingEdges& edges) {
  std::map<int, std::vector<std::size_t>> at;
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const int p : edges[e]) at[p].push_back(e);
  std::vector<char> seen(edges.size(), 0);
  std::vector<RingEdges> out;
  for (std::size_t first = 0; first < edges.size(); ++first) {
    if (seen[first]) continue;
    out.emplace_back();
    std::vector<std::size_t> front{first};
    seen[first] = 1;
    while (!front.empty()) {
      const std::size_t e = front.back();
      front.pop_back();
      out.back().push_back(edges[e]);
      for (const int p : edges[e])
        for (const std::size_t next : at[p])
          if (!seen[next]) {
            seen[next] = 1;
            front.push_back(next);
          }
    }
  }
  return out;
}

/// To 0.01 mm.
std::string place(const Vec3& x) {
  const Vec3 rounded = (100 * x).array().round() / 100 + 0.0;  // no negative zero
  std::ostringstream out;
  out << '(' << rounded.x() << ", " << rounded.y() << ", " << rounded.z() << ") mm";
  return out.str();
}

}  // namespace

std::string bare_ring_text(const Points& points, const RingEdges& edges) {
  const std::vector<RingEdges> found = runs(edges);
  const RingEdges* longest = &found.front();
  for (const RingEdges& run : found)
    if (length_of(points, run) > length_of(points, *longest)) longest = &run;
  std::set<int> vertices;
  for (const auto& edge : *longest) vertices.insert(edge.begin(), edge.end());
  Vec3 centre = Vec3::Zero();
  for (const int p : vertices) centre += points.col(p) / static_cast<double>(vertices.size());
  std::ostringstream out;
  out.precision(4);
  out << "mesh: endocardium and epicardium meet in an edge without a base between them: found "
      << (vertices.size() == longest->size() ? "a ring " : "an edge ") << length_of(points, *longest)
      << " mm long about " << place(centre) << ", through " << place(points.col(longest->front()[0]))
      << ", at which the wall has no thickness"
      << (found.size() > 1 ? ", and " + std::to_string(found.size() - 1) + " more" : "")
      << "; expected a base, the face that closes the wall at the valve ring: cut the wall below the ring, "
         "where it still has a thickness, and close the cut with triangles of the base";
  return out.str();
}

void check_bare_rings(const Points& points, const polyaffine::Triangles& boundary,
                      const std::vector<int>& labels) {
  std::set<int> base;
  for (std::size_t f = 0; f < labels.size(); ++f)
    if (const auto t = boundary.col(static_cast<Eigen::Index>(f)); labels[f] == kBase)
      base.insert(t.begin(), t.end());
  const polyaffine::Triangles across = polyaffine::triangle_adjacency(boundary).across;
  RingEdges bare;
  for (Eigen::Index f = 0; f < boundary.cols(); ++f) {
    if (labels[f] != kEndocardium && labels[f] != kRvEndocardium) continue;
    for (int k = 0; k < 3; ++k) {
      const int n = across(k, f), a = boundary(k, f), b = boundary((k + 1) % 3, f);
      if (n >= 0 && labels[n] == kEpicardium && !(base.contains(a) && base.contains(b)))
        bare.push_back({a, b});
    }
  }
  if (!bare.empty()) throw polyaffine::InputError(bare_ring_text(points, bare));
}

}  // namespace cardiac
