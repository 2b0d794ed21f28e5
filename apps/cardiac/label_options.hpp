#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include <cardiac/anatomy/fibre_fields.hpp>

namespace cardiac::app {

/// Where a command finds the labels of surfaces: words of its command line.
struct LabelOptions {
  std::vector<std::string> surface_files;  ///< as surface_files() takes them
  std::string label_array, region_array;
  std::vector<std::string> endo, epi, base, rv_endo, region;  ///< numbers or names
};

/// --surface-file, --label-array, --endo-label, --epi-label, --base-label, --rv-endo-label. The options must
/// outlive the parsing.
void add_label_options(CLI::App& command, LabelOptions& options);

/// --region, --region-array; as add_label_options.
void add_region_options(CLI::App& command, LabelOptions& options);

/// --fibre-array, --sheet-array; as add_label_options.
void add_fibre_options(CLI::App& command, FibreArrays& arrays);

}  // namespace cardiac::app
