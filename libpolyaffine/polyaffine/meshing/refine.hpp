#pragma once

// CGAL's own checks stay on in every build type: before 6.3 its smoothing can hide a vertex behind a
// protected edge (CGAL pull request 9541) and without the checks goes on with freed memory instead of
// throwing.
#define CGAL_DEBUG

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/assertions_behaviour.h>
#include <CGAL/make_mesh_3.h>

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/quality.hpp>
#include <polyaffine/meshing/implicit_domain.hpp>
#include <string>
#include <utility>

/// What the meshers of this folder share; for its sources only (it brings CGAL along).
namespace polyaffine::mesh3 {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

template <class Domain>
using Triangulation = typename CGAL::Mesh_triangulation_3<Domain>::type;
template <class Domain>
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation<Domain>, typename Domain::Corner_index,
                                                        typename Domain::Curve_index>;

inline void check_positive(const char* name, double length) {
  if (!(length > 0) || !std::isfinite(length))
    throw InputError(std::string(name) + ": found " + std::to_string(length) +
                     " mm, expected a positive length");
}

inline void check_sizes(const MeshSizes& sizes) {
  check_positive("cell_mm", sizes.cell_mm);
  check_positive("facet_mm", sizes.facet_mm);
  check_positive("facet_distance_mm", sizes.facet_distance_mm);
  check_positive("edge_mm", sizes.edge_mm);
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

/// A length times a factor of the place, in the form in which CGAL asks for sizes.
struct SizeField {
  using FT = Kernel::FT;
  using Point_3 = Kernel::Point_3;
  double length_mm;
  const std::function<double(const Point_3&)>* factor;

  template <class Index>
  FT operator()(const Point_3& x, int /*dimension*/, const Index& /*index*/) const {
    return length_mm * (*factor)(x);
  }
};

/// Delaunay refinement, ODT smoothing, perturbation. `factor` (null: 1) scales all sizes with the place.
template <class Domain>
Complex<Domain> refine(const Domain& domain, const MeshSizes& sizes, int smoothing_steps,
                       const std::function<double(const Kernel::Point_3&)>* factor = nullptr) {
  namespace params = CGAL::parameters;
  using Criteria = CGAL::Mesh_criteria_3<Triangulation<Domain>>;
  const auto field = [&](double length_mm) { return SizeField{length_mm, factor}; };
  const Criteria criteria =
      factor == nullptr
          ? Criteria(params::edge_size = sizes.edge_mm, params::facet_angle = 25,
                     params::facet_size = sizes.facet_mm, params::facet_distance = sizes.facet_distance_mm,
                     params::cell_radius_edge_ratio = 2, params::cell_size = sizes.cell_mm)
          : Criteria(params::edge_size = field(sizes.edge_mm), params::facet_angle = 25,
                     params::facet_size = field(sizes.facet_mm),
                     params::facet_distance = field(sizes.facet_distance_mm),
                     params::cell_radius_edge_ratio = 2, params::cell_size = field(sizes.cell_mm));
  auto complex =
      CGAL::make_mesh_3<Complex<Domain>>(domain, criteria, params::no_perturb(), params::no_exude());
  if (smoothing_steps > 0)
    CGAL::odt_optimize_mesh_3(complex, domain, params::max_iteration_number = smoothing_steps);
  CGAL::perturb_mesh_3(complex, domain, params::sliver_bound = sizes.min_dihedral_deg);
  return complex;
}

/// Points and tets of a complex; points are numbered as the tets meet them.
template <class Complex>
std::pair<Points, Tets> tets_of(const Complex& complex) {
  using VertexHandle = typename Complex::Vertex_handle;
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
  return {std::move(points), std::move(tets)};
}

/// The best of several meshes. A few smoothing steps even out the tets; many pull interior vertices apart
/// near the edges. When CGAL fails or stays far from the aim, other starting positions of the perturbation
/// mostly help.
inline TetMesh best_mesh(const MeshSizes& sizes, const std::function<TetMesh(int smoothing_steps)>& make) {
  const QuietCgal quiet;
  std::optional<TetMesh> best;
  double best_dihedral_deg = 0;
  std::string failure;
  for (const int smoothing_steps : {5, 4, 3, 0}) {
    try {
      TetMesh mesh = make(smoothing_steps);
      const double dihedral_deg = mesh_quality(mesh).min_dihedral_deg;
      if (dihedral_deg > best_dihedral_deg) {
        best = std::move(mesh);
        best_dihedral_deg = dihedral_deg;
      }
      if (best_dihedral_deg > 0.9 * sizes.min_dihedral_deg) break;
    } catch (const CGAL::Failure_exception&) {
      failure = "CGAL could not improve the mesh; try a slightly different size";
    } catch (const InputError& error) {
      failure = std::string("no valid mesh: ") + error.what();
    } catch (const ComputationError& error) {
      failure = error.what();
    }
  }
  if (!best) throw ComputationError("meshing: " + failure);
  return *std::move(best);
}

}  // namespace polyaffine::mesh3
