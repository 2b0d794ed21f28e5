#include "polyaffine/mesh/digest.hpp"

#include <span>
#include <sstream>

#include <polyaffine/core/fnv1a.hpp>

namespace polyaffine {
std::string digest(const TetMesh& mesh) {
  Fnv1a hash;
  hash.add(std::span(mesh.points().data(), static_cast<std::size_t>(mesh.points().size())));
  hash.add(std::span(mesh.tets().data(), static_cast<std::size_t>(mesh.tets().size())));
  hash.add(std::span(mesh.regions()));
  hash.add(std::span(mesh.boundary_labels()));
  std::ostringstream text;
  text << mesh.num_points() << " vertices, " << mesh.num_tets() << " tets, checksum " << std::hex
       << hash.value();
  return text.str();
}

std::string digest(const Matrix& values) {
  Fnv1a hash;
  hash.add(std::span(values.data(), static_cast<std::size_t>(values.size())));
  std::ostringstream text;
  text << std::hex << hash.value();
  return text.str();
}

}  // namespace polyaffine
