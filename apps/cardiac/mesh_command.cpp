#include "mesh_command.hpp"

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <polyaffine/core/error.hpp>
#include <polyaffine/mesh/quality.hpp>
#include <polyaffine/mesh/surface.hpp>
#include <string>

#include "ellipsoid_mesh.hpp"
#include "import_command.hpp"
#include "output_file.hpp"

#ifdef CARDIAC_WITH_VTK
#include <polyaffine/vtk/write.hpp>
#endif

namespace cardiac::app {
namespace {

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
  TruncatedEllipsoid shape = o.shape == "land" ? land_ellipsoid() : human_lv();
  shape.endo_short_mm = o.endo_short_mm.value_or(shape.endo_short_mm);
  shape.endo_long_mm = o.endo_long_mm.value_or(shape.endo_long_mm);
  shape.epi_short_mm = o.epi_short_mm.value_or(shape.epi_short_mm);
  shape.epi_long_mm = o.epi_long_mm.value_or(shape.epi_long_mm);
  shape.base_z_mm = o.base_z_mm.value_or(shape.base_z_mm);
  check_shape(shape);
  return shape;
}

void print_summary(const TruncatedEllipsoid& shape, const TetMesh& mesh) {
  constexpr double kMm3PerMl = 1000;
  const auto quality = polyaffine::mesh_quality(mesh);
  const polyaffine::EnclosedVolume cavity(mesh, {kEndocardium});
  std::cout << "tets                 " << mesh.num_tets() << "\nvertices             " << mesh.num_points()
            << "\nboundary triangles   " << mesh.boundary().cols() << " (endocardium "
            << mesh.surface({kEndocardium}).cols() << ", epicardium " << mesh.surface({kEpicardium}).cols()
            << ", base " << mesh.surface({kBase}).cols() << ")\ncavity_volume_mL     "
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
  check_output_file(o.out, ".vtu");
  const TruncatedEllipsoid shape = chosen_shape(o);
  const TetMesh mesh = mesh_truncated_ellipsoid(shape, o.size_mm.value_or(default_mesh_size_mm(shape)));
  write_mesh(o.out, mesh);
  print_summary(shape, mesh);
  std::cout << "written              " << o.out.string() << '\n';
}

}  // namespace

void add_mesh_command(CLI::App& app) {
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
  ellipsoid->add_option("--size", options->size_mm, "edge length aimed at, mm (default: 0.52 of the wall)");
  ellipsoid->add_option("--endo-short", options->endo_short_mm, "endocardial short semi-axis, mm");
  ellipsoid->add_option("--endo-long", options->endo_long_mm, "endocardial long semi-axis, mm");
  ellipsoid->add_option("--epi-short", options->epi_short_mm, "epicardial short semi-axis, mm");
  ellipsoid->add_option("--epi-long", options->epi_long_mm, "epicardial long semi-axis, mm");
  ellipsoid->add_option("--base-z", options->base_z_mm, "height of the base plane above the centre, mm");
  ellipsoid->add_option("--out", options->out, "file to write, .vtu, lengths in mm")->required();
  ellipsoid->callback([options] { run_ellipsoid(*options); });
  add_import_command(*mesh);
}

}  // namespace cardiac::app
