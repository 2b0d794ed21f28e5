#include "polyaffine/mesh/digest.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <sstream>

namespace polyaffine {
namespace {

class Fnv1a {
 public:
  template <class T>
  void add(std::span<const T> values) {
    for (const std::byte b : std::as_bytes(values))
      hash_ = (hash_ ^ std::to_integer<std::uint64_t>(b)) * kPrime;
  }
  std::uint64_t value() const { return hash_; }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3;
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace

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
