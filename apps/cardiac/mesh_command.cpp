#include "mesh_command.hpp"

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <polyaffine/core/error.hpp>
#include <string>

#include <cardiac/core/units.hpp>

#include "biventricle_mesh.hpp"
#include "ellipsoid_mesh.hpp"
#include "import_command.hpp"
#include "mesh_report.hpp"
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
  print_counts(mesh, {{kEndocardium, "endocardium"}, {kEpicardium, "epicardium"}, {kBase, "base"}});
  std::cout << "cavity_volume_mL     " << cavity_mL(mesh, kEndocardium) << " (exact shape "
            << exact_cavity_volume(shape) / mm3_per_mL << ")\nwall_volume_mL       "
            << mesh.volume() / mm3_per_mL << " (exact shape " << exact_wall_volume(shape) / mm3_per_mL
            << ")\n";
  print_quality(mesh);
}

void print_biventricle(const TetMesh& mesh) {
  print_counts(
      mesh, {{kEndocardium, "lv_endo"}, {kRvEndocardium, "rv_endo"}, {kEpicardium, "epi"}, {kBase, "base"}});
  std::map<int, double> wall_mm3;
  for (int t = 0; t < mesh.num_tets(); ++t) wall_mm3[mesh.regions()[t]] += mesh.tet_volume(t);
  std::cout << "cavity_volume_mL     lv " << cavity_mL(mesh, kEndocardium) << ", rv "
            << cavity_mL(mesh, kRvEndocardium) << "\nwall_volume_mL       lv "
            << wall_mm3[kLvWall] / mm3_per_mL << ", rv " << wall_mm3[kRvWall] / mm3_per_mL << ", septum "
            << wall_mm3[kSeptum] / mm3_per_mL << '\n';
  print_quality(mesh);
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

struct BiventricleOptions {
  std::optional<double> size_mm;
  std::filesystem::path out;
};

void run_biventricle(const BiventricleOptions& o) {
#ifndef CARDIAC_WITH_VTK
  throw InputError("cardiac mesh: this build was made without VTK (CMake option POLYAFFINE_WITH_VTK)");
#endif
  check_output_file(o.out, ".vtu");
  const IdealisedBiventricle shape = human_biventricle();
  const TetMesh mesh = mesh_biventricle(shape, o.size_mm.value_or(default_mesh_size_mm(shape)));
  write_mesh(o.out, mesh);
  print_biventricle(mesh);
  std::cout << "written              " << o.out.string() << '\n';
}

}  // namespace

void add_mesh_command(CLI::App& app) {
  CLI::App* mesh = app.add_subcommand("mesh",
                                      "Make a mesh with labelled surfaces (1 endocardium, 2 epicardium, "
                                      "3 base, 4 right endocardium)");
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
  CLI::App* biventricle = mesh->add_subcommand(
      "biventricle",
      "Idealised left and right ventricle of human size, apex towards −z, right ventricle towards +x");
  const auto both = std::make_shared<BiventricleOptions>();
  biventricle->add_option("--size", both->size_mm,
                          "edge length aimed at, mm (default: 1.1 of the right wall)");
  biventricle->add_option("--out", both->out, "file to write, .vtu, lengths in mm")->required();
  biventricle->callback([both] { run_biventricle(*both); });
  add_import_command(*mesh);
}

}  // namespace cardiac::app
