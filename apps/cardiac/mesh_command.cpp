#include "mesh_command.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/quality.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <string>

#ifdef CARDIAC_WITH_CGAL
#include <polyaffine/meshing/implicit_domain.hpp>
#endif
#ifdef CARDIAC_WITH_VTK
#include <polyaffine/vtk/write.hpp>
#endif

namespace {

using cardiac::TruncatedEllipsoid;
using polyaffine::InputError;
using polyaffine::TetMesh;

struct EllipsoidOptions {
  std::string shape = "human";
  std::optional<double> size_mm, endo_short_mm, endo_long_mm, epi_short_mm, epi_long_mm, base_z_mm;
  std::filesystem::path out;
};

TruncatedEllipsoid chosen_shape(const EllipsoidOptions& o) {
  if (o.shape != "human" && o.shape != "land")
    throw InputError("--shape: found \"" + o.shape + "\", expected human or land");
  TruncatedEllipsoid shape = o.shape == "land" ? cardiac::land_ellipsoid() : cardiac::human_lv();
  shape.endo_short_mm = o.endo_short_mm.value_or(shape.endo_short_mm);
  shape.endo_long_mm = o.endo_long_mm.value_or(shape.endo_long_mm);
  shape.epi_short_mm = o.epi_short_mm.value_or(shape.epi_short_mm);
  shape.epi_long_mm = o.epi_long_mm.value_or(shape.epi_long_mm);
  shape.base_z_mm = o.base_z_mm.value_or(shape.base_z_mm);
  check(shape);
  return shape;
}

void print_summary(const TruncatedEllipsoid& shape, const TetMesh& mesh) {
  constexpr double kMm3PerMl = 1000;
  const auto quality = polyaffine::mesh_quality(mesh);
  const polyaffine::EnclosedVolume cavity(mesh, {cardiac::kEndocardium});
  std::cout << "tets                 " << mesh.num_tets() << "\nvertices             " << mesh.num_points()
            << "\nboundary triangles   " << mesh.boundary().cols() << " (endocardium "
            << mesh.surface({cardiac::kEndocardium}).cols() << ", epicardium "
            << mesh.surface({cardiac::kEpicardium}).cols() << ", base "
            << mesh.surface({cardiac::kBase}).cols() << ")\ncavity_volume_mL     "
            << cavity.value(mesh.points()) / kMm3PerMl << " (exact shape "
            << exact_cavity_volume(shape) / kMm3PerMl << ")\nwall_volume_mL       "
            << mesh.volume() / kMm3PerMl << " (exact shape " << exact_wall_volume(shape) / kMm3PerMl
            << ")\nedge_length_mm       " << quality.min_edge_mm << " to " << quality.max_edge_mm << ", mean "
            << quality.mean_edge_mm << "\ndihedral_angle_deg   " << quality.min_dihedral_deg << " to "
            << quality.max_dihedral_deg << "\nradius_ratio         " << quality.min_radius_ratio
            << " at worst, mean " << quality.mean_radius_ratio << "\naspect_ratio         "
            << quality.max_aspect_ratio << " at worst, mean " << quality.mean_aspect_ratio << '\n';
}

void write_mesh([[maybe_unused]] const std::filesystem::path& out, [[maybe_unused]] const TetMesh& mesh) {
#ifdef CARDIAC_WITH_VTK
  polyaffine::write_vtu(out, mesh);
#endif
}

void run_ellipsoid(const EllipsoidOptions& o) {
#ifndef CARDIAC_WITH_VTK
  throw InputError("cardiac mesh: this build was made without VTK (CMake option POLYAFFINE_WITH_VTK)");
#endif
  if (o.out.extension() != ".vtu")
    throw InputError("--out: found \"" + o.out.string() + "\", expected a file name that ends in .vtu");
  const auto folder = o.out.has_parent_path() ? o.out.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder))
    throw InputError("--out: found no folder " + folder.string() + " to write into");
  const TruncatedEllipsoid shape = chosen_shape(o);
  const double wall_mm = shape.epi_short_mm - shape.endo_short_mm;
  const TetMesh mesh = mesh_truncated_ellipsoid(shape, o.size_mm.value_or(wall_mm / 2));
  write_mesh(o.out, mesh);
  print_summary(shape, mesh);
  std::cout << "written              " << o.out.string() << '\n';
}

}  // namespace

#ifdef CARDIAC_WITH_CGAL
TetMesh mesh_truncated_ellipsoid(const TruncatedEllipsoid& shape, double size_mm) {
  check(shape);
  const double wall_mm =
      std::min(shape.epi_short_mm - shape.endo_short_mm, shape.epi_long_mm - shape.endo_long_mm);
  if (!(size_mm > 0) || size_mm > 2 * wall_mm)
    throw InputError("size: found " + std::to_string(size_mm) + " mm, expected more than 0 and at most " +
                     std::to_string(2 * wall_mm) + " mm (twice the thinnest wall)");
  // The mesher leaves boundary vertices within its own tolerance of the surface, far below 1 % of the wall.
  const double on_surface_mm = 0.01 * wall_mm;
  polyaffine::ImplicitDomain domain;
  domain.value = [&](const polyaffine::Vec3& x) { return wall_function(shape, x); };
  domain.radius_mm = 1.1 * std::max(shape.epi_long_mm, shape.epi_short_mm);
  // Fine enough that the polygon's sagitta, r (1 − cos(π/n)), is far below the tolerance above.
  for (const auto& rim : rims(shape, 360)) domain.edges.push_back(rim);
  domain.project = [&](const polyaffine::Vec3& x) {
    return project_to_wall_surface(shape, on_surface_mm, x);
  };
  domain.label = [&](const std::array<polyaffine::Vec3, 3>& triangle) {
    return surface_label(shape, on_surface_mm, triangle);
  };
  // A regular tet of edge h has the circumradius .61 h, a regular triangle .58 h.
  polyaffine::MeshSizes sizes;
  sizes.cell_mm = 0.75 * size_mm;
  sizes.facet_mm = 0.7 * size_mm;
  sizes.facet_distance_mm = 0.1 * size_mm;
  sizes.edge_mm = size_mm;
  return mesh_implicit_domain(domain, sizes);
}
#else
TetMesh mesh_truncated_ellipsoid(const TruncatedEllipsoid&, double) {
  throw InputError(
      "meshing an ellipsoid: this build was made without CGAL (CMake option "
      "POLYAFFINE_WITH_CGAL)");
}
#endif

void add_mesh_command(CLI::App& app, int& status) {
  CLI::App* mesh = app.add_subcommand("mesh",
                                      "Make a mesh with labelled surfaces (1 endocardium, 2 epicardium, "
                                      "3 base)");
  mesh->require_subcommand(1);
  CLI::App* ellipsoid = mesh->add_subcommand(
      "ellipsoid", "Idealised left ventricle between two truncated ellipsoids, apex towards −z");
  const auto options = std::make_shared<EllipsoidOptions>();
  ellipsoid
      ->add_option("--shape", options->shape, "human (unloaded, cavity 75 mL) or land (Land et al. 2015)")
      ->capture_default_str();
  ellipsoid->add_option("--size", options->size_mm, "edge length aimed at, mm (default: half the wall)");
  ellipsoid->add_option("--endo-short", options->endo_short_mm, "endocardial short semi-axis, mm");
  ellipsoid->add_option("--endo-long", options->endo_long_mm, "endocardial long semi-axis, mm");
  ellipsoid->add_option("--epi-short", options->epi_short_mm, "epicardial short semi-axis, mm");
  ellipsoid->add_option("--epi-long", options->epi_long_mm, "epicardial long semi-axis, mm");
  ellipsoid->add_option("--base-z", options->base_z_mm, "height of the base plane above the centre, mm");
  ellipsoid->add_option("--out", options->out, "file to write, .vtu, lengths in mm")->required();
  ellipsoid->callback([options, &status] {
    run_ellipsoid(*options);
    status = 0;
  });
}
