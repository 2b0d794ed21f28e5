#include "polyaffine/meshing/implicit_domain.hpp"

#include <polyaffine/meshing/refine.hpp>

#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>

#include <random>

namespace polyaffine {
namespace {

using mesh3::Kernel;
using Domain = CGAL::Mesh_domain_with_polyline_features_3<CGAL::Labeled_mesh_domain_3<Kernel>>;
using Complex = mesh3::Complex<Domain>;

// Relative to the bounding sphere: how exactly the mesher finds the surface along a segment.
constexpr double kSurfaceError = 1e-6;

/// CGAL looks for a first surface point for ever when there is none.
void check_inside(const ImplicitDomain& domain) {
  std::mt19937 random(0);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  bool inside = false, outside = false;
  for (int i = 0; i < 100000 && !(inside && outside); ++i) {
    const Vec3 direction(coordinate(random), coordinate(random), coordinate(random));
    if (direction.norm() > 1) continue;
    (domain.value(domain.centre + domain.radius_mm * direction) < 0 ? inside : outside) = true;
  }
  if (!inside || !outside)
    throw InputError("meshing: found " + std::string(inside ? "only points inside" : "no point inside") +
                     " the solid within its bounding sphere of radius " + std::to_string(domain.radius_mm) +
                     " mm, expected points on both sides of its surface");
}

Kernel::Point_3 to_cgal(const Vec3& x) {
  return {x.x(), x.y(), x.z()};
}

Complex build(const ImplicitDomain& domain, const MeshSizes& sizes, int smoothing_steps) {
  namespace params = CGAL::parameters;
  CGAL::Random random(0);
  CGAL::get_default_random() = CGAL::Random(0);
  const double square = domain.radius_mm * domain.radius_mm;
  Domain cgal_domain = Domain::create_implicit_mesh_domain(
      params::function = [&](const Kernel::Point_3& p) { return domain.value(Vec3(p.x(), p.y(), p.z())); },
      params::bounding_object = Kernel::Sphere_3(to_cgal(domain.centre), square), params::p_rng = &random,
      params::relative_error_bound = kSurfaceError);
  std::vector<std::vector<Kernel::Point_3>> edges;
  for (const Points& edge : domain.edges) {
    auto& polyline = edges.emplace_back();
    for (Eigen::Index i = 0; i < edge.cols(); ++i) polyline.push_back(to_cgal(edge.col(i)));
  }
  cgal_domain.add_features(edges.begin(), edges.end());

  return mesh3::refine(cgal_domain, sizes, smoothing_steps);
}

/// The tets of the complex with projected and labelled boundary.
TetMesh to_mesh(const Complex& complex, const ImplicitDomain& domain) {
  auto [points, tets] = mesh3::tets_of(complex);
  const TetMesh bare(points, tets);
  std::vector<char> on_boundary(points.cols(), 0);
  for (const int i : bare.boundary().reshaped()) on_boundary[i] = 1;
  if (domain.project)
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      if (on_boundary[i]) points.col(i) = domain.project(points.col(i));
  LabelledTriangles surface;
  if (domain.label) {
    surface.triangles = bare.boundary();
    for (const auto& face : bare.boundary().colwise())
      surface.labels.push_back(
          domain.label({Vec3(points.col(face[0])), Vec3(points.col(face[1])), Vec3(points.col(face[2]))}));
  }
  return TetMesh(std::move(points), std::move(tets), {}, surface);
}

}  // namespace

TetMesh mesh_implicit_domain(const ImplicitDomain& domain, const MeshSizes& given) {
  MeshSizes sizes = given;
  if (domain.edges.empty()) sizes.edge_mm = sizes.facet_mm;
  mesh3::check_sizes(sizes);
  mesh3::check_positive("radius_mm", domain.radius_mm);
  check_inside(domain);
  return mesh3::best_mesh(
      sizes, [&](int smoothing_steps) { return to_mesh(build(domain, sizes, smoothing_steps), domain); });
}

}  // namespace polyaffine
