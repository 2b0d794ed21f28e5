#include "polyaffine/mesh_io/mesh_data.hpp"

namespace polyaffine {

void note_quadratic(MeshData& data, std::size_t quadratic_tets) {
  if (quadratic_tets > 0)
    data.notes.push_back(std::to_string(quadratic_tets) +
                         " quadratic tetrahedra: their corners are kept, edges become straight");
}

}  // namespace polyaffine
