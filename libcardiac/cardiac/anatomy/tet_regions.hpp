#pragma once

#include <string>
#include <vector>

#include <cardiac/anatomy/surface_names.hpp>
#include <polyaffine/mesh_io/mesh_data.hpp>

namespace cardiac {

/// Which tets of a file are the wall.
struct RegionChoice {
  std::vector<SurfaceLabel> wanted{};  ///< numbers or names; empty: all tets
  std::string array{};  ///< array of tets with the numbers; empty: the first of the usual names (region, …)
};

/// Keeps the tets of the wanted regions with their fields; a note says how many went. Throws InputError,
/// listing the regions of the file, when one is not there, or the arrays when none holds regions.
void keep_regions(polyaffine::MeshData& data, const RegionChoice& choice);

/// The regions of a file in words: `1 "myocardium" (1200 tets), 2 (340 tets)`; empty when all tets have the
/// same one or none.
std::string regions_in_words(const polyaffine::MeshData& data, const std::string& array);

}  // namespace cardiac
