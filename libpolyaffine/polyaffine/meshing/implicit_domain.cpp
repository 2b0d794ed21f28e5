#include "polyaffine/meshing/implicit_domain.hpp"

// CGAL's own checks stay on in every build type: before 6.3 its smoothing can hide a vertex behind a
// protected edge (CGAL pull request 9541) and without the checks goes on with freed memory instead of
// throwing.
#define CGAL_DEBUG

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/assertions_behaviour.h>
#include <CGAL/make_mesh_3.h>

#include <cmath>
#include <map>
#include <optional>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/quality.hpp>
#include <random>
#include <string>

namespace polyaffine {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Mesh_domain_with_polyline_features_3<CGAL::Labeled_mesh_domain_3<Kernel>>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex =
    CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
using VertexHandle = Triangulation::Vertex_handle;

// Relative to the bounding sphere: how exactly the mesher finds the surface along a segment.
constexpr double kSurfaceError = 1e-6;

void check_sizes(const ImplicitDomain& domain, const MeshSizes& sizes) {
  const auto positive = [](const char* name, double value) {
    if (!(value > 0) || !std::isfinite(value))
      throw InputError(std::string(name) + ": found " + std::to_string(value) +
                       " mm, expected a positive length");
  };
  positive("cell_mm", sizes.cell_mm);
  positive("facet_mm", sizes.facet_mm);
  positive("facet_distance_mm", sizes.facet_distance_mm);
  if (!domain.edges.empty()) positive("edge_mm", sizes.edge_mm);
  positive("radius_mm", domain.radius_mm);
}

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

/// CGAL throws its failures; while this lives it does not print them as well.
class QuietCgal {
 public:
  QuietCgal() : previous_(CGAL::set_error_handler(ignore)) {}
  ~QuietCgal() { CGAL::set_error_handler(previous_); }
  QuietCgal(const QuietCgal&) = delete;
  QuietCgal& operator=(const QuietCgal&) = delete;

 private:
  static void ignore(const char*, const char*, const char*, int, const char*) {}
  CGAL::Failure_function previous_;
};

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

  const Criteria criteria(params::edge_size = edges.empty() ? sizes.facet_mm : sizes.edge_mm,
                          params::facet_angle = 25, params::facet_size = sizes.facet_mm,
                          params::facet_distance = sizes.facet_distance_mm,
                          params::cell_radius_edge_ratio = 2, params::cell_size = sizes.cell_mm);
  auto complex = CGAL::make_mesh_3<Complex>(cgal_domain, criteria, params::no_perturb(), params::no_exude());
  if (smoothing_steps > 0)
    CGAL::odt_optimize_mesh_3(complex, cgal_domain, params::max_iteration_number = smoothing_steps);
  CGAL::perturb_mesh_3(complex, cgal_domain, params::sliver_bound = sizes.min_dihedral_deg);
  return complex;
}

/// The tets of the complex with projected and labelled boundary.
TetMesh to_mesh(const Complex& complex, const ImplicitDomain& domain) {
  if (complex.number_of_cells_in_complex() == 0)
    throw ComputationError("found no tetrahedra inside the solid; the sizes are too coarse for it");

  std::map<VertexHandle, int> number;
  std::vector<VertexHandle> vertices;
  Tets tets(4, static_cast<Eigen::Index>(complex.number_of_cells_in_complex()));
  Eigen::Index t = 0;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell, ++t)
    for (int k = 0; k < 4; ++k) {
      const auto [it, added] = number.try_emplace(cell->vertex(k), static_cast<int>(vertices.size()));
      if (added) vertices.push_back(it->first);
      tets(k, t) = it->second;
    }
  Points points(3, static_cast<Eigen::Index>(vertices.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const auto& p = vertices[i]->point().point();
    points.col(i) = Vec3(p.x(), p.y(), p.z());
  }

  try {
    const TetMesh bare(points, tets);
    std::vector<char> on_boundary(vertices.size(), 0);
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
  } catch (const InputError& error) {
    throw ComputationError(std::string("no valid mesh: ") + error.what());
  }
}

}  // namespace

TetMesh mesh_implicit_domain(const ImplicitDomain& domain, const MeshSizes& sizes) {
  check_sizes(domain, sizes);
  check_inside(domain);
  const QuietCgal quiet;
  // A few steps even out the tets; many pull interior vertices apart near the edges. When CGAL fails or stays
  // far from the aim, other starting positions of the perturbation mostly help.
  std::optional<TetMesh> best;
  double best_dihedral_deg = 0;
  std::string failure;
  for (const int smoothing_steps : {5, 4, 3, 0}) {
    try {
      TetMesh mesh = to_mesh(build(domain, sizes, smoothing_steps), domain);
      const double dihedral_deg = mesh_quality(mesh).min_dihedral_deg;
      if (dihedral_deg > best_dihedral_deg) {
        best = std::move(mesh);
        best_dihedral_deg = dihedral_deg;
      }
      if (best_dihedral_deg > 0.9 * sizes.min_dihedral_deg) break;
    } catch (const CGAL::Failure_exception&) {
      failure = "CGAL could not improve the mesh; try a slightly different size";
    } catch (const ComputationError& error) {
      failure = error.what();
    }
  }
  if (!best) throw ComputationError("meshing: " + failure);
  return *std::move(best);
}

}  // namespace polyaffine
