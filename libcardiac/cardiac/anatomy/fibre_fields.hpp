#pragma once

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace cardiac {

/// Arrays that hold fibres under names of their own; empty: the names that tools use.
struct FibreArrays {
  std::string fibre{}, sheet{};
};

/// Gives the fibre fields of a file (point or tet vectors, of the given names or those that tools use: fiber,
/// f0, sheet, n0, …) the names "fibre", "sheet" and "sheet_normal"; drops all other fields but "region"
/// unless `all` are kept. Returns what was kept, in words. Throws InputError, naming file, field and place,
/// where a vector has no length, and when a given array is missing or has other than 3 components.
std::vector<std::string> keep_fibre_fields(polyaffine::MeshData& data, const FibreArrays& arrays, bool all);

}  // namespace cardiac
