#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <cardiac/heart/beat_result.hpp>

namespace cardiac {

struct Figure {
  std::string file;  ///< its name in the result folder
  std::string svg;
};

/// Peak longitudinal, circumferential and radial strain, and activation where there is one
/// (bullseye_*.svg); none for a result without segment strains.
std::vector<Figure> bullseye_figures(const BeatResult& result);

/// All figures that the result has data for: bullseye_*.svg, strain_curves.svg, pv_loop.svg.
std::vector<Figure> figures(const BeatResult& result);

/// Writes figures() into the folder `out` (made where missing), each whole or not at all, and removes figures
/// of an earlier run there that this result has no data for. Errors as of polyaffine::write_atomically.
void write_figures(const BeatResult& result, const std::filesystem::path& out);

}  // namespace cardiac
