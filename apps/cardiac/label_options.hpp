#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include <cardiac/anatomy/fibre_fields.hpp>

namespace cardiac::app {

/// Where a command finds the labels of surfaces: words of its command line.
struct LabelOptions {
  std::string surface_file, label_array;
  std::vector<std::string> endo, epi, base, rv_endo;  ///< numbers or names
};

/// --surface-file, --label-array, --endo-label, --epi-label, --base-label, --rv-endo-label. The options must
/// outlive the parsing.
void add_label_options(CLI::App& command, LabelOptions& options);

/// --fibre-array, --sheet-array; as add_label_options.
void add_fibre_options(CLI::App& command, FibreArrays& arrays);

}  // namespace cardiac::app
