#pragma once

#include <polyaffine/mesh_io/mesh_data.hpp>

namespace cardiac {

/// Gives the fibre fields of a file (point or tet vectors under the names that tools use: fiber, f0, sheet,
/// n0, …) the names "fibre", "sheet" and "sheet_normal" and notes it; drops all other fields but "region"
/// unless `all` are kept. Throws InputError, naming file, field and place, where a vector has no length.
void keep_fibre_fields(polyaffine::MeshData& data, bool all);

}  // namespace cardiac
