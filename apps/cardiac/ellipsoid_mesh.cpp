#include "ellipsoid_mesh.hpp"

#include <algorithm>
#include <string>

#include <polyaffine/core/error.hpp>

#ifdef CARDIAC_WITH_CGAL
#include <polyaffine/meshing/implicit_domain.hpp>
#endif

namespace cardiac::app {

using polyaffine::InputError;
using polyaffine::TetMesh;

#ifdef CARDIAC_WITH_CGAL
TetMesh mesh_truncated_ellipsoid(const TruncatedEllipsoid& shape, double size_mm) {
  check_shape(shape);
  const double wall_mm =
      std::min(shape.epi_short_mm - shape.endo_short_mm, shape.epi_long_mm - shape.endo_long_mm);
  if (!(size_mm > 0) || size_mm > 2 * wall_mm)
    throw InputError("size: found " + std::to_string(size_mm) + " mm, expected more than 0 and at most " +
                     std::to_string(2 * wall_mm) + " mm (twice the thinnest wall)");
  // The mesher leaves boundary vertices within its own tolerance of the surface, far below 1 % of the wall.
  const double on_surface_mm = 0.01 * wall_mm;
  polyaffine::ImplicitDomain domain;
  domain.value = [&](const polyaffine::Vec3& x) { return wall_function(shape, x); };
  domain.radius_mm = 1.1 * std::max(shape.epi_long_mm, shape.epi_short_mm);
  // Fine enough that the polygon's sagitta, r (1 − cos(π/n)), is far below the tolerance above.
  for (const auto& rim : rims(shape, 360)) domain.edges.push_back(rim);
  domain.project = [&](const polyaffine::Vec3& x) {
    return project_to_wall_surface(shape, on_surface_mm, x);
  };
  domain.label = [&](const std::array<polyaffine::Vec3, 3>& triangle) {
    return surface_label(shape, on_surface_mm, triangle);
  };
  return mesh_implicit_domain(domain, polyaffine::sizes_for_edge(size_mm));
}
#else
TetMesh mesh_truncated_ellipsoid(const TruncatedEllipsoid&, double) {
  throw InputError(
      "meshing an ellipsoid: this build was made without CGAL (CMake option "
      "POLYAFFINE_WITH_CGAL)");
}
#endif

}  // namespace cardiac::app
