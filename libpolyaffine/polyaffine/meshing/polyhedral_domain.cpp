#include "polyaffine/meshing/polyhedral_domain.hpp"

#include <polyaffine/meshing/refine.hpp>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>

#include <array>
#include <iterator>
#include <sstream>
#include <vector>

namespace polyaffine {
namespace {

using mesh3::Kernel;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel, Polyhedron>;
using Face = boost::graph_traits<Polyhedron>::face_descriptor;

constexpr double kSharpDeg = 50;

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

}  // namespace

TetMesh mesh_polyhedral_domain(const Points& points, const Triangles& triangles, const MeshSizes& sizes) {
  mesh3::check_sizes(sizes);
  const Polyhedron surface = to_polyhedron(points, triangles);
  check_apart(surface);
  return mesh3::best_mesh(sizes, [&](int smoothing_steps) {
    CGAL::Random random(0);
    CGAL::get_default_random() = CGAL::Random(0);
    Domain domain(surface, &random);
    domain.detect_features(kSharpDeg);
    auto [corners, tets] = mesh3::tets_of(mesh3::refine(domain, sizes, smoothing_steps));
    return TetMesh(std::move(corners), std::move(tets));
  });
}

}  // namespace polyaffine
