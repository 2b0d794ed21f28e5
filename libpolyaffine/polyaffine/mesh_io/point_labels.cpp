#include "polyaffine/mesh_io/point_labels.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <set>
#include <tuple>

#include <polyaffine/mesh/tet_faces.hpp>
#include <polyaffine/mesh/triangle_adjacency.hpp>
#include <polyaffine/mesh_io/label_fields.hpp>

namespace polyaffine {
namespace {

constexpr int kSmoothings = 3;

/// The faces of one tet only.
Triangles boundary_triangles(const Tets& tets) {
  const std::vector<TetFace> faces = sorted_faces(tets);
  CellList out{3};
  for (std::size_t f = 0; f < faces.size(); ++f)
    if ((f == 0 || faces[f - 1].key != faces[f].key) &&
        (f + 1 == faces.size() || faces[f + 1].key != faces[f].key))
      out.add(faces[f].key);
  return out.matrix();
}

Points unit_normals(const MeshData& data) {
  Points out(3, data.triangles.cols());
  for (Eigen::Index t = 0; t < out.cols(); ++t) {
    const Mat3 x = data.points(Eigen::all, data.triangles.col(t));
    out.col(t) = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).normalized();
  }
  return out;
}

/// The labels of the triangles while they are being found.
struct Borders {
  Triangles corners;  ///< labels of the corners, ascending
  Triangles across;   ///< neighbours
  Points normals;
  std::vector<int> label;   ///< of each triangle
  std::vector<char> known;  ///< has it one?

  bool has(int t, int wanted) const { return (corners.col(t).array() == wanted).any(); }
  bool same(int t) const { return corners(0, t) == corners(2, t); }
  bool two(int t) const { return corners(0, t) == corners(1, t) || corners(1, t) == corners(2, t); }
  int size() const { return static_cast<int>(label.size()); }
  void set(int t, int to) {
    label[t] = to;
    known[t] = 1;
  }

  /// Triangles that one label alone claims.
  void seed() {
    std::set<int> whole;
    for (int t = 0; t < size(); ++t)
      if (same(t)) {
        whole.insert(corners(0, t));
        set(t, corners(0, t));
      }
    for (int t = 0; t < size(); ++t)
      if (two(t) && !whole.contains(corners(1, t))) set(t, corners(1, t));
  }

  void grow() {
    using Step = std::tuple<double, int, int, int>;  // sharpness, order of arrival, triangle, label
    std::priority_queue<Step, std::vector<Step>, std::greater<>> front;
    int arrival = 0;
    const auto spread = [&](int t) {
      for (int k = 0; k < 3; ++k)
        if (const int n = across(k, t); n >= 0 && !known[n] && has(n, label[t]))
          front.emplace(1 - std::abs(normals.col(t).dot(normals.col(n))), arrival++, n, label[t]);
    };
    for (int t = 0; t < size(); ++t)
      if (known[t]) spread(t);
    while (!front.empty()) {
      const auto [sharpness, order, t, grown] = front.top();
      front.pop();
      if (known[t]) continue;
      set(t, grown);
      spread(t);
    }
  }

  /// A triangle on a border that two of another label surround belongs to them: borders without teeth.
  void smooth() {
    for (int pass = 0; pass < kSmoothings; ++pass)
      for (int t = 0; t < size(); ++t) {
        if (same(t)) continue;
        for (int k = 0; k < 3; ++k) {
          const int a = across(k, t), b = across((k + 1) % 3, t);
          if (a >= 0 && b >= 0 && label[a] == label[b] && has(t, label[a])) label[t] = label[a];
        }
      }
  }
};

}  // namespace

void label_triangles_by_points(MeshData& data, const std::string& name) {
  const std::vector<int> of_point = integer_field(data, data.point_fields, name);
  std::map<int, int> points;
  for (const int label : of_point) ++points[label];
  if (data.triangles.cols() == 0) {
    data.triangles = boundary_triangles(data.tets);
    data.triangle_fields.clear();
  }
  const auto size = static_cast<std::size_t>(data.triangles.cols());
  Borders borders{data.triangles, triangle_adjacency(data.triangles).across, unit_normals(data),
                  std::vector<int>(size), std::vector<char>(size, 0)};
  for (auto t : borders.corners.colwise()) {
    for (int& corner : t) corner = of_point[corner];
    std::ranges::sort(t);
  }
  borders.seed();
  borders.grow();
  int whole = 0;
  for (int t = 0; t < borders.size(); ++t) {
    whole += borders.same(t);
    if (borders.known[t]) continue;
    const auto corners = borders.corners.col(t);
    borders.label[t] = borders.two(t)
                           ? corners[1]
                           : *std::ranges::min_element(corners, {}, [&](int label) { return points[label]; });
  }
  borders.smooth();
  Matrix& field = data.triangle_fields[name] = Matrix(1, data.triangles.cols());
  for (int t = 0; t < borders.size(); ++t) field(0, t) = borders.label[t];
  data.notes.push_back("triangles labelled by the point array \"" + name + "\": " + std::to_string(whole) +
                       " by all three corners, " + std::to_string(borders.size() - whole) +
                       " on borders by the flattest edge to a neighbour");
}

}  // namespace polyaffine
