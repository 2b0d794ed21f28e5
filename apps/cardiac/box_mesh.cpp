#include "box_mesh.hpp"

#include <array>
#include <cmath>
#include <string>

#include <polyaffine/core/error.hpp>

#ifdef CARDIAC_WITH_CGAL
#include <polyaffine/meshing/implicit_domain.hpp>
#endif

namespace cardiac::app {

using polyaffine::InputError;
using polyaffine::TetMesh;
using polyaffine::Vec3;

#ifdef CARDIAC_WITH_CGAL
TetMesh mesh_box(const Vec3& size_mm, double edge_mm) {
  if (!(size_mm.minCoeff() > 0) || !(edge_mm > 0))
    throw InputError("box: found a size or an edge length that is not positive, mm");
  const double near = 1e-3 * size_mm.minCoeff();
  polyaffine::ImplicitDomain domain;
  domain.centre = size_mm / 2;
  domain.radius_mm = 0.6 * size_mm.norm();
  domain.value = [&](const Vec3& x) {
    return (x - size_mm / 2).cwiseAbs().cwiseQuotient(size_mm / 2).maxCoeff() - 1;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner) {
      polyaffine::Points edge = polyaffine::Points::Zero(3, 2);
      edge.row((axis + 1) % 3).setConstant((corner & 1) != 0 ? size_mm[(axis + 1) % 3] : 0);
      edge.row((axis + 2) % 3).setConstant((corner & 2) != 0 ? size_mm[(axis + 2) % 3] : 0);
      edge(axis, 1) = size_mm[axis];
      domain.edges.push_back(edge);
    }
  domain.project = [&](const Vec3& x) {
    Vec3 out = x;
    for (int k = 0; k < 3; ++k)
      for (const double face : {0.0, size_mm[k]})
        if (std::abs(x[k] - face) < near) out[k] = face;
    return out;
  };
  domain.label = [&](const std::array<Vec3, 3>& triangle) {
    for (int k = 0; k < 3; ++k)
      for (int side = 0; side < 2; ++side) {
        const double face = side * size_mm[k];
        if (triangle[0][k] == face && triangle[1][k] == face && triangle[2][k] == face)
          return 2 * k + side + 1;
      }
    throw polyaffine::ComputationError("box: a boundary triangle lies on none of the six faces");
  };
  return mesh_implicit_domain(domain, polyaffine::sizes_for_edge(edge_mm));
}
#else
TetMesh mesh_box(const Vec3&, double) {
  throw InputError("meshing a box: this build was made without CGAL (CMake option POLYAFFINE_WITH_CGAL)");
}
#endif

}  // namespace cardiac::app
