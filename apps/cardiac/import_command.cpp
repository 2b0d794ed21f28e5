#include "import_command.hpp"

#include <iostream>
#include <memory>
#include <optional>

#include <cardiac/anatomy/idealised.hpp>
#include <cardiac/core/units.hpp>
#include <polyaffine/core/error.hpp>

#include "label_options.hpp"
#include "mesh_report.hpp"
#include "output_file.hpp"
#include "read_heart.hpp"
#include "surface_mesh.hpp"
#include "warnings.hpp"

#ifdef CARDIAC_WITH_VTK
#include <polyaffine/vtk/write.hpp>
#endif

namespace cardiac::app {
namespace {

using polyaffine::InputError;
using polyaffine::TetMesh;

struct ImportOptions {
  std::filesystem::path file, out;
  std::string length_unit;
  LabelOptions labels;
  FibreArrays fibres;
  std::optional<double> size_mm;
  bool all_fields = false;
};

void print_report(const TetMesh& mesh) {
  const bool right = mesh.surface({kRvEndocardium}).cols() > 0;
  std::vector<NamedSurface> surfaces{
      {kEndocardium, "endocardium"}, {kEpicardium, "epicardium"}, {kBase, "base"}};
  if (right) surfaces.push_back({kRvEndocardium, "right endocardium"});
  if (mesh.surface({TetMesh::kUnlabelled}).cols() > 0)
    surfaces.push_back({TetMesh::kUnlabelled, "unlabelled"});
  print_counts(mesh, surfaces);
  std::cout << "cavity_volume_mL     " << (right ? "lv " : "") << cavity_mL(mesh, kEndocardium);
  if (right) std::cout << ", rv " << cavity_mL(mesh, kRvEndocardium);
  std::cout << "\nwall_volume_mL       " << mesh.volume() / mm3_per_mL << '\n';
  print_quality(mesh);
}

HeartMesh read(const ImportOptions& o) {
  HeartMeshOptions options;
  options.mm_per_unit = mm_per_unit(length_unit(o.length_unit));
  options.label_array = o.labels.label_array;
  options.labels = {surface_labels(o.labels.endo), surface_labels(o.labels.epi),
                    surface_labels(o.labels.base), surface_labels(o.labels.rv_endo)};
  options.regions = {surface_labels(o.labels.region), o.labels.region_array};
  options.fibre_arrays = o.fibres;
  options.all_fields = o.all_fields;
  polyaffine::MeshData data = read_any_mesh(o.file);
  if (is_surface(data)) {
    const auto refuse = [&](const char* option, bool given) {
      if (given)
        throw InputError(std::string(option) + ": given beside the closed surface " + o.file.string() +
                         ", expected beside a mesh of tetrahedra");
    };
    refuse("--surface-file", !o.labels.surface_files.empty());
    refuse("--region", !o.labels.region.empty());
    return fill_surface(std::move(data), options, o.size_mm);
  }
  if (o.size_mm)
    throw InputError("--size: given for the tetrahedra of " + o.file.string() +
                     ", expected only with a closed surface");
  return read_heart(std::move(data), surface_files(o.labels.surface_files), options);
}

void write(const ImportOptions& o, [[maybe_unused]] const HeartMesh& heart) {
#ifdef CARDIAC_WITH_VTK
  polyaffine::write_vtu(o.out, heart.file.mesh,
                        {.point_fields = heart.file.point_fields, .cell_fields = heart.file.cell_fields});
#else
  throw InputError(o.out.string() + ": this build writes no VTK files (CMake option POLYAFFINE_WITH_VTK)");
#endif
}

void import(const ImportOptions& o) {
  check_output_file(o.out, ".vtu", "--out", o.file);
  const HeartMesh heart = read(o);
  write(o, heart);
  std::vector<std::string> warnings;
  for (const std::string& text : heart.warnings) warnings.push_back(o.file.string() + ": " + text);
  print_warnings(warnings);
  std::cout << "read                 " << o.file.string() << '\n';
  for (const auto* notes : {&heart.fibres, &heart.file.notes})
    for (const std::string& note : *notes) std::cout << "                     " << note << '\n';
  print_report(heart.file.mesh);
  std::cout << "                     a run takes this shape as free of stress: one imaged under pressure is "
               "filled once more\n                     and its volumes come out too large\n"
            << "written              " << o.out.string() << " (mm)\n";
}

}  // namespace

void add_import_command(CLI::App& mesh) {
  CLI::App* command = mesh.add_subcommand(
      "import", "Mesh or closed surface of another tool as tetrahedra with labelled surfaces, in mm");
  const auto o = std::make_shared<ImportOptions>();
  command
      ->add_option("FILE", o->file,
                   "tetrahedra (.vtu, .vtk, Gmsh .msh, openCARP .pts) or a closed surface (.stl, .off, .obj, "
                   ".ply, .vtp, .vtk)")
      ->required();
  command->add_option("--length-unit", o->length_unit, "length unit of the file: mm, cm, m or um")
      ->required();
  command->add_option("--out", o->out, "file to write, .vtu, lengths in mm")->required();
  add_label_options(*command, o->labels);
  add_region_options(*command, o->labels);
  add_fibre_options(*command, o->fibres);
  command->add_option("--size", o->size_mm,
                      "edge length inside a closed surface, mm (default: half the wall)");
  command->add_flag("--keep-fields", o->all_fields, "keep every numeric array, not only fibres");
  command->callback([o] { import(*o); });
}

}  // namespace cardiac::app
