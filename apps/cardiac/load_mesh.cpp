#include "load_mesh.hpp"

#include <utility>

#include <polyaffine/core/error.hpp>

#include "biventricle_mesh.hpp"
#include "ellipsoid_mesh.hpp"
#include "read_heart.hpp"

namespace cardiac::app {
namespace {

HeartMeshOptions options_of(const protocol::Mesh& mesh) {
  HeartMeshOptions options;
  options.mm_per_unit = mm_per_unit(*mesh.length_unit);
  options.label_array = mesh.label_array.value_or("");
  options.labels = {mesh.endo_label.value_or(protocol::Labels{}), mesh.epi_label.value_or(protocol::Labels{}),
                    mesh.base_label.value_or(protocol::Labels{}),
                    mesh.rv_endo_label.value_or(protocol::Labels{})};
  return options;
}

polyaffine::TetMesh read(const Protocol& protocol, std::vector<std::string>& warnings) {
  HeartMesh heart = read_heart(mesh_path(protocol),
                               protocol.mesh.surface_file ? surface_path(protocol) : std::filesystem::path(),
                               options_of(protocol.mesh));
  for (const auto& list : {heart.warnings, heart.file.notes})
    for (const std::string& text : list) warnings.push_back(mesh_path(protocol).string() + ": " + text);
  return std::move(heart.file.mesh);
}

polyaffine::TetMesh generate(const Protocol& protocol) {
  if (*protocol.mesh.shape == protocol::Shape::human_biventricle) {
    const IdealisedBiventricle shape = human_biventricle();
    return mesh_biventricle(shape, protocol.mesh.size_mm.value_or(default_mesh_size_mm(shape)));
  }
  const bool human = *protocol.mesh.shape == protocol::Shape::human_lv;
  const TruncatedEllipsoid shape = human ? human_lv() : land_ellipsoid();
  return mesh_truncated_ellipsoid(shape, protocol.mesh.size_mm.value_or(default_mesh_size_mm(shape)));
}

}  // namespace

Anatomy load_anatomy(const Protocol& protocol, std::vector<std::string>& warnings) {
  if (protocol.mesh.shape) return build_anatomy(generate(protocol), protocol);
  polyaffine::TetMesh mesh = read(protocol, warnings);
  try {
    return build_anatomy(std::move(mesh), protocol);
  } catch (const polyaffine::InputError& error) {
    throw polyaffine::InputError(mesh_path(protocol).string() + ": " + error.what());
  }
}

}  // namespace cardiac::app
