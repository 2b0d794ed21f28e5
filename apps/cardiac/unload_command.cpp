#include "unload_command.hpp"

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/activation/activation.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/fibres/file_fibres.hpp>
#include <cardiac/report/filling.hpp>
#include <cardiac/run/unload.hpp>
#include <polyaffine/core/error.hpp>

#include "example_data.hpp"
#include "interrupt.hpp"
#include "load_mesh.hpp"
#include "output_file.hpp"
#include "progress.hpp"
#include "warnings.hpp"

#ifdef CARDIAC_WITH_VTK
#include <polyaffine/vtk/write.hpp>
#endif

namespace cardiac::app {
namespace {

using polyaffine::InputError;

struct UnloadOptions {
  std::string protocol, out, method;
  std::vector<std::string> overrides;
  bool quiet = false, force = false;
};

#ifdef CARDIAC_WITH_VTK
// The fields that the protocol reads of its mesh file, under the names that it has for them, and the way to
// the image.
polyaffine::WriteFields fields(const Protocol& protocol, const Scene& unloaded) {
  const Anatomy& heart = *unloaded.heart;
  polyaffine::WriteFields out;
  out.point_fields["to_image_mm"] = protocol.heart->mesh.points() - heart.mesh.points();
  if (const auto* fibres = heart.fibres.target<FileFibreFunction>())
    for (const auto& [usual, field] : fibres->fibres->fields()) {
      std::string name = usual;
      if (usual == "fibre") name = protocol.fibres->fibre_array.value_or(name);
      if (usual == "sheet") name = protocol.fibres->sheet_array.value_or(name);
      (field->of_tets() ? out.cell_fields : out.point_fields)[name] = field->vectors();
    }
  if (protocol.boundary.epicardial_weight_array)
    out.point_fields[*protocol.boundary.epicardial_weight_array] = heart.epicardial_weight.transpose();
  if (unloaded.activation && unloaded.activation->map) {
    const auto& a = *protocol.activation;
    const double ms = a.array_s ? ms_per_s : 1;
    out.point_fields[a.array_ms ? *a.array_ms : a.array_s.value_or("activation_ms")] =
        unloaded.activation->map->times_ms.transpose() / ms;
  }
  return out;
}

void write(const std::string& file, const Protocol& protocol, const Scene& unloaded) {
  polyaffine::write_vtu(file, unloaded.heart->mesh, fields(protocol, unloaded));
}
#else
void write(const std::string&, const Protocol&, const Scene&) {}
#endif

// What of the protocol is told in the coordinates of the image, at the stress-free shape.
void print_landmarks(const Protocol& protocol, const Scene& unloaded) {
  const auto tell = [](const char* key, const polyaffine::Vec3& X) {
    std::cout << key << " = [" << X.x() << ", " << X.y() << ", " << X.z() << "]\n";
  };
  const AnatomyOptions& o = unloaded.heart->options;
  if (o.septum_point) tell("anatomy.septum_point", *o.septum_point);
  if (o.rv_insertion_point) tell("anatomy.rv_insertion_point", *o.rv_insertion_point);
  if (o.mitral_point) tell("anatomy.mitral_point", *o.mitral_point);
  if (!protocol.activation) return;
  for (const auto& X : unloaded.activation->sites_mm)
    tell("activation.sites_mm: one of them", polyaffine::Vec3(X.data()));
}

void unload_heart(UnloadOptions options) {
#ifndef CARDIAC_WITH_VTK
  throw InputError("cardiac unload: this build was made without VTK (CMake option POLYAFFINE_WITH_VTK)");
#endif
  if (!options.method.empty()) options.overrides.push_back("reduction.method=" + options.method);
  const Protocol protocol =
      load_input(given_or_example(options.protocol), options.overrides, {.insist = options.force});
  if (!protocol.imaged)
    throw InputError(
        "mesh.pressure_mmHg: missing or 0, expected the pressure under which the mesh was imaged, mmHg");
  check_output_file(options.out, ".vtu", "--out",
                    protocol.mesh.file ? mesh_path(protocol) : std::filesystem::path());
  print_warnings(protocol.warnings);
  const InterruptGuard interrupt;
  Unloading found;
  {
    ProgressLine line(options.quiet);
    RunControl control;
    control.progress = [&line](const std::string& what, double fraction) { line(what, fraction); };
    control.stop_reason = [&interrupt] { return interrupt.reason(); };
    found = unload(protocol, control);
  }
  print_warnings(found.warnings);
  const Scene unloaded = unloaded_scene(protocol, found.heart);
  write(options.out, protocol, unloaded);
  if (options.quiet) return;
  std::cout << unloading_text(found.result) << '\n';
  print_landmarks(protocol, unloaded);
  std::cout << "written " << options.out
            << " (lengths in mm, surfaces 1 endocardium, 2 epicardium, 3 base, 4 right endocardium): to be "
               "run without mesh.pressure_mmHg\n";
}

}  // namespace

void add_unload_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "unload", "Find the stress-free shape of a mesh that was imaged under mesh.pressure_mmHg.");
  auto options = std::make_shared<UnloadOptions>();
  command->add_option("PROTOCOL", options->protocol, "protocol file (.toml)")->required();
  command->add_option("--out", options->out, "mesh file to write, .vtu, lengths in mm")
      ->type_name("FILE.vtu")
      ->required();
  command->add_option("--set", options->overrides, "override a protocol key; the value in TOML")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--method", options->method, "polyaffine (reduced) or fem (full order)")
      ->check(CLI::IsMember({"polyaffine", "fem"}));
  command->add_flag("--force", options->force, "take a wall of any size");
  command->add_flag("--quiet", options->quiet, "no progress, no summary; warnings go to stderr in any case");
  command->callback([options] { unload_heart(*options); });
}

}  // namespace cardiac::app
