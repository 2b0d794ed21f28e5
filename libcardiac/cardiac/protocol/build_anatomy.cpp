#include "cardiac/protocol/build_anatomy.hpp"

#include <string>
#include <utility>

#include <polyaffine/core/error.hpp>

namespace cardiac {

using polyaffine::Vec3;

namespace {

void check_scheme(bool two_ventricles, const std::optional<protocol::Scheme>& scheme) {
  if (!scheme || two_ventricles == (*scheme == protocol::Scheme::aha29)) return;
  throw polyaffine::InputError(
      two_ventricles ? "anatomy.scheme: found aha17, but the mesh has two ventricles (a right endocardium); "
                       "expected aha29"
                     : "anatomy.scheme: found aha29, but the mesh has no right endocardium (boundary label " +
                           std::to_string(kRvEndocardium) + "); expected aha17");
}

}  // namespace

TruncatedEllipsoid ellipsoid_of(const protocol::Mesh& mesh) {
  if (mesh.shape != protocol::Shape::human_lv) return land_ellipsoid();
  return scaled(human_lv(), mesh.cavity_scale, mesh.wall_scale);
}

Anatomy build_anatomy(polyaffine::TetMesh mesh, const Protocol& protocol, const ExactGeometry& exact) {
  check_scheme(mesh.surface({kRvEndocardium}).cols() > 0, protocol.anatomy.scheme);
  AnatomyOptions options;
  const double mm = protocol.mesh.length_unit ? mm_per_unit(*protocol.mesh.length_unit) : 1;
  const auto vector = [](const std::optional<protocol::Vector3>& v, double factor) {
    return v ? std::optional(Vec3(factor * Vec3(v->data()))) : std::nullopt;
  };
  options.long_axis = vector(protocol.anatomy.long_axis, 1);
  options.anterior = vector(protocol.anatomy.anterior_direction, 1);
  options.septum_point = vector(protocol.anatomy.septum_point, mm);
  options.rv_insertion_point = vector(protocol.anatomy.rv_insertion_point, mm);
  options.mitral_point = vector(protocol.anatomy.mitral_point, mm);
  options.midpoints = exact.midpoints;
  return make_anatomy(std::move(mesh), options, exact.fibres);
}

}  // namespace cardiac
