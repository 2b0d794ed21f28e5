#include "polyaffine/meshing/polyhedral_domain.hpp"

#include <polyaffine/meshing/refine.hpp>
#include <polyaffine/meshing/thickness.hpp>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>

#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <queue>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include <polyaffine/mesh/surface.hpp>
#include <polyaffine/mesh/triangle_adjacency.hpp>

namespace polyaffine {
namespace {

using mesh3::Kernel;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel, Polyhedron>;
using Face = boost::graph_traits<Polyhedron>::face_descriptor;

constexpr double kSharpDeg = 50;
// Of the sizes where the body is thin: part of its thickness, least part of the sizes given, growth by mm.
constexpr double kOfThickness = 0.7, kLeast = 0.125, kGrowth = 0.5;
constexpr const char* kMisfit =
    "the boundary of the tetrahedra touches itself, is pierced or misses a part of the body";
// Shares of the sizes that are tried.
constexpr std::array kFiner{1.0, 0.7, 0.5};
// Of the volume: what chords of a curved surface may leave out or add.
constexpr double kVolumeError = 0.1;

Polyhedron to_polyhedron(const Points& points, const Triangles& triangles) {
  namespace processing = CGAL::Polygon_mesh_processing;
  std::vector<Kernel::Point_3> corners;
  for (const auto& x : points.colwise()) corners.emplace_back(x.x(), x.y(), x.z());
  std::vector<std::array<std::size_t, 3>> faces;
  for (const auto& t : triangles.cast<std::size_t>().colwise()) faces.push_back({t[0], t[1], t[2]});
  if (!processing::is_polygon_soup_a_polygon_mesh(faces))
    throw InputError("surface: found triangles that do not fit together, expected a closed surface");
  Polyhedron out;
  processing::polygon_soup_to_polygon_mesh(corners, faces, out);
  return out;
}

void check_apart(const Polyhedron& surface) {
  std::vector<std::pair<Face, Face>> meeting;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(meeting));
  if (meeting.empty()) return;
  const auto& x = meeting.front().first->halfedge()->vertex()->point();
  std::ostringstream text;
  text << "surface: found " << meeting.size() << " pairs of triangles that intersect, one near (" << x.x()
       << ", " << x.y() << ", " << x.z() << ") mm, expected a surface that does not meet itself";
  throw InputError(text.str());
}

/// Sizes relative to the largest ones, by the thickness of the body.
class ThinFactor {
 public:
  ThinFactor(const Points& points, const Triangles& triangles, double edge_mm) : edge_mm_(edge_mm) {
    const Vector thickness = thickness_behind(points, triangles);
    size_mm_ = (kOfThickness * thickness).cwiseMax(kLeast * edge_mm).cwiseMin(edge_mm);
    for (const auto& t : triangles.colwise())
      soup_.emplace_back(to_cgal(points.col(t[0])), to_cgal(points.col(t[1])), to_cgal(points.col(t[2])));
    grow_gently(points, triangles);
    tree_.insert(soup_.cbegin(), soup_.cend());
    tree_.build();
  }
  ThinFactor(const ThinFactor&) = delete;
  ThinFactor& operator=(const ThinFactor&) = delete;

  bool needed() const { return size_mm_.minCoeff() < edge_mm_; }
  double operator()(const Kernel::Point_3& x) const {
    const auto [nearest, primitive] = tree_.closest_point_and_primitive(x);
    const double distance = std::sqrt(CGAL::squared_distance(nearest, x));
    return std::min(1.0, (size_mm_[primitive - soup_.cbegin()] + kGrowth * distance) / edge_mm_);
  }

 private:
  static Kernel::Point_3 to_cgal(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

  /// A size exceeds that of a neighbour by at most kGrowth times their distance: smallest first, as Dijkstra.
  void grow_gently(const Points& points, const Triangles& triangles) {
    const Triangles across = triangle_adjacency(triangles).across;
    const auto centre = [&](int f) { return Vec3(points(Eigen::all, triangles.col(f)).rowwise().mean()); };
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (int f = 0; f < static_cast<int>(size_mm_.size()); ++f) front.emplace(size_mm_[f], f);
    while (!front.empty()) {
      const auto [size, f] = front.top();
      front.pop();
      if (size > size_mm_[f]) continue;
      for (const int n : across.col(f)) {
        if (n < 0) continue;
        const double most = size + kGrowth * (centre(f) - centre(n)).norm();
        if (most >= size_mm_[n]) continue;
        size_mm_[n] = most;
        front.emplace(most, n);
      }
    }
  }

  using Soup = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Soup::const_iterator>;
  double edge_mm_;
  Vector size_mm_;
  Soup soup_;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

/// Vertices − edges + triangles of a closed surface: 2 − 2 × handles.
Eigen::Index euler_number(const Triangles& triangles) {
  const std::set<int> vertices(triangles.data(), triangles.data() + triangles.size());
  return static_cast<Eigen::Index>(vertices.size()) - triangles.cols() / 2;
}

/// Is the boundary of a filling of the kind of the surface?
bool fits(const TetMesh& mesh, const Triangles& surface, double volume) {
  const TriangleAdjacency adjacency = triangle_adjacency(mesh.boundary());
  return adjacency.crowded.empty() && adjacency.open.empty() &&
         pinched_vertex(mesh.boundary(), adjacency.across) < 0 &&
         euler_number(mesh.boundary()) == euler_number(surface) &&
         std::abs(mesh.volume() - volume) < kVolumeError * volume;
}

MeshSizes scaled(MeshSizes sizes, double factor) {
  sizes.cell_mm *= factor;
  sizes.facet_mm *= factor;
  sizes.facet_distance_mm *= factor;
  sizes.edge_mm *= factor;
  return sizes;
}

}  // namespace

TetMesh mesh_polyhedral_domain(const Points& points, const Triangles& triangles, const MeshSizes& sizes) {
  mesh3::check_sizes(sizes);
  const Polyhedron surface = to_polyhedron(points, triangles);
  check_apart(surface);
  const ThinFactor thin(points, triangles, sizes.edge_mm);
  const std::function<double(const Kernel::Point_3&)> factor = std::cref(thin);
  const double volume = -EnclosedVolume(triangles).value(points);
  const auto fill = [&](const MeshSizes& tried) {
    int misfits = 0;
    return mesh3::best_mesh(tried, [&](int smoothing_steps) {
      if (misfits > 1) throw ComputationError(kMisfit);  // not for want of smoothing
      CGAL::Random random(0);
      CGAL::get_default_random() = CGAL::Random(0);
      Domain domain(surface, &random);
      domain.detect_features(kSharpDeg);
      auto [corners, tets] =
          mesh3::tets_of(mesh3::refine(domain, tried, smoothing_steps, thin.needed() ? &factor : nullptr));
      TetMesh mesh(std::move(corners), std::move(tets));
      if (!fits(mesh, triangles, volume)) {
        ++misfits;
        throw ComputationError(kMisfit);
      }
      return mesh;
    });
  };
  for (const double share : kFiner) try {
      return fill(scaled(sizes, share));
    } catch (const ComputationError& error) {
      if (share > kFiner.back()) continue;
      const ThinPlace place = thinnest_place(points, triangles);
      std::ostringstream text;
      text.precision(3);
      text << error.what() << "; tried with edges of about " << sizes.edge_mm << " mm and finer. The body is "
           << place.thickness_mm << " mm thick near (" << place.place.x() << ", " << place.place.y() << ", "
           << place.place.z() << ") mm: smaller sizes, of about " << 0.5 * place.thickness_mm
           << " mm, may fill it";
      throw ComputationError(text.str());
    }
  throw ComputationError("meshing: no size tried");  // not reached: the last share throws
}

}  // namespace polyaffine
