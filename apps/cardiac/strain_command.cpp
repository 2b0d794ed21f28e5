#include "strain_command.hpp"

#include <filesystem>
#include <iostream>
#include <memory>

#include <cardiac/report/result_reader.hpp>
#include <cardiac/report/tables.hpp>
#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac::app {
namespace {

struct StrainOptions {
  std::filesystem::path folder, out;
  bool frames = false, peaks = false;
};

void print_strain(const StrainOptions& options) {
  const BeatResult result = read_result(options.folder).result;
  const std::string table = options.frames  ? affine_table(result)
                            : options.peaks ? peaks_table(result)
                                            : strain_table(result);
  if (!options.out.empty()) return polyaffine::write_atomically(options.out, table);
  std::cout << table << std::flush;
  if (!std::cout) throw polyaffine::ComputationError("cannot write the table to standard output");
}

}  // namespace

void add_strain_command(CLI::App& app) {
  const auto options = std::make_shared<StrainOptions>();
  CLI::App* command = app.add_subcommand("strain", "Segment strain tables of a finished run");
  command->add_option("RESULT_DIR", options->folder, "Folder that `cardiac run` wrote")->required();
  CLI::Option* frames =
      command->add_flag("--frames", options->frames,
                        "The affine map that fits each segment's motion since end diastole best, over time: "
                        "12 parameters, rotation, stretches, determinant, misfit (affine.csv)");
  command
      ->add_flag("--peaks", options->peaks,
                 "Peaks of each normal strain, their times, end-systolic values, post-systolic index")
      ->excludes(frames);
  command->add_option("--out", options->out, "File to write (default: standard output)")
      ->type_name("FILE.csv");
  command->callback([options] { print_strain(*options); });
}

}  // namespace cardiac::app
