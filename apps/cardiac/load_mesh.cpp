#include "load_mesh.hpp"

#include <utility>

#include <polyaffine/core/error.hpp>

#include "ellipsoid_mesh.hpp"

#ifdef CARDIAC_WITH_VTK
#include <polyaffine/vtk/read.hpp>
#endif

namespace cardiac::app {
namespace {

polyaffine::TetMesh read(const Protocol& protocol) {
#ifdef CARDIAC_WITH_VTK
  double mm_per_unit = 1;
  if (protocol.mesh.length_unit == protocol::LengthUnit::cm) mm_per_unit = 10;
  if (protocol.mesh.length_unit == protocol::LengthUnit::m) mm_per_unit = 1000;
  polyaffine::ReadOptions options;
  options.label_array = protocol.mesh.label_array;
  return polyaffine::read_vtu(mesh_path(protocol), mm_per_unit, options);
#else
  throw polyaffine::InputError("mesh.file: found " + mesh_path(protocol).string() +
                               ", but this build reads no .vtu files (VTK is off); use mesh.shape");
#endif
}

polyaffine::TetMesh generate(const Protocol& protocol) {
  const bool human = *protocol.mesh.shape == protocol::Shape::human_lv;
  const TruncatedEllipsoid shape = human ? human_lv() : land_ellipsoid();
  return mesh_truncated_ellipsoid(shape, protocol.mesh.size_mm.value_or(default_mesh_size_mm(shape)));
}

}  // namespace

Anatomy load_anatomy(const Protocol& protocol) {
  if (protocol.mesh.shape) return build_anatomy(generate(protocol), protocol);
  polyaffine::TetMesh mesh = read(protocol);
  try {
    return build_anatomy(std::move(mesh), protocol);
  } catch (const polyaffine::InputError& error) {
    throw polyaffine::InputError(mesh_path(protocol).string() + ": " + error.what());
  }
}

}  // namespace cardiac::app
