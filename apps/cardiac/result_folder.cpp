#include "result_folder.hpp"

#include <algorithm>
#include <array>
#include <regex>
#include <string>
#include <vector>

#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac::app {
namespace {

namespace fs = std::filesystem;

bool is_result(const std::string& file) {
  constexpr std::array kNames{
      "summary.json",  "report.html",     "strain.csv",        "strain_peaks.csv",
      "affine.csv",    "cavity.csv",      "strain_curves.svg", "pv_loop.svg",
      "wall.svg",      "heart.pvd",       "global_strain.csv", "control_nodes.csv",
      "frames.csv",    "circulation.csv", "time_curves.svg",   "strain_curves_right.svg",
      "mechanics.csv", "filling.csv",     "filling.svg"};
  static const std::regex numbered("heart_[0-9]{4,}\\.vtu|bullseye_[a-z_]+\\.svg");
  return std::ranges::find(kNames, file) != kNames.end() || std::regex_match(file, numbered);
}

}  // namespace

void remove_old_results(const fs::path& folder) {
  polyaffine::remove_abandoned(folder);
  fs::remove(folder / "summary.json");
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_result(entry.path().filename().string())) old.push_back(entry.path());
  for (const fs::path& file : old) fs::remove(file);
}

void check_not_a_result(const fs::path& read, const fs::path& folder) {
  std::error_code none;
  if (is_result(read.filename().string()) && fs::equivalent(fs::absolute(read).parent_path(), folder, none))
    throw polyaffine::InputError("--out: found the folder " + folder.string() + " of " + read.string() +
                                 ", which is read and would be removed; expected another folder");
}

}  // namespace cardiac::app
