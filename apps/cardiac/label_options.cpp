#include "label_options.hpp"

namespace cardiac::app {

void add_label_options(CLI::App& command, LabelOptions& options) {
  const auto add = [&](const char* name, std::vector<std::string>& labels, const char* surface) {
    command.add_option(name, labels, std::string("numbers or names, divided by commas, of the ") + surface)
        ->delimiter(',')
        ->allow_extra_args(false);
  };
  command
      .add_option(
          "--surface-file", options.surface_files,
          "second file with the labelled triangles; or NAME=FILE, as often as there are surfaces of one "
          "file each (NAME: endo, epi, base, rv_endo)")
      ->allow_extra_args(false);
  command.add_option("--label-array", options.label_array,
                     "cell or point array of the surface labels (default: surface, label, tag, physical, …)");
  add("--endo-label", options.endo, "endocardium (left ventricle)");
  add("--epi-label", options.epi, "epicardium");
  add("--base-label", options.base, "base");
  add("--rv-endo-label", options.rv_endo, "right endocardium");
}

void add_region_options(CLI::App& command, LabelOptions& options) {
  command
      .add_option("--region", options.region,
                  "tets that are the wall: numbers or names, divided by commas (default: all tets)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--region-array", options.region_array,
                     "array of tets with their regions (default: region, material, tag, physical, …)");
}

void add_fibre_options(CLI::App& command, FibreArrays& arrays) {
  command.add_option("--fibre-array", arrays.fibre,
                     "array with the fibre directions (default: fibre, fiber, f0, …)");
  command.add_option("--sheet-array", arrays.sheet,
                     "array with the sheet directions (default: sheet, s0, sheet_normal, …)");
}

}  // namespace cardiac::app
