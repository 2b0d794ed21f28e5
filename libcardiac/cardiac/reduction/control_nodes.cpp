#include "cardiac/reduction/control_nodes.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include <cardiac/anatomy/right_ventricle.hpp>
#include <cardiac/fibres/helix.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/locate.hpp>

namespace cardiac {

using polyaffine::Mat3;
using polyaffine::Vec3;
using polyaffine::Vec4;

namespace {

// How far, in mm along each coordinate, a point is from mid-wall at (u, ψ).
Vec3 mismatch(const CoordinateSample& at, double u, double psi) {
  return {(at.u - u) / at.grad_u.norm(),
          std::remainder(at.psi - psi, 2 * polyaffine::kPi) / at.grad_psi.norm(),
          (at.t - 0.5) / at.grad_t.norm()};
}

// Newton's method on the position, from the tet whose centre matches best.
ControlNode find(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                 const std::vector<CoordinateSample>& centres, double u, double psi) {
  ControlNode node;
  double least = std::numeric_limits<double>::infinity();
  for (int t = 0; t < mesh.num_tets(); ++t)
    if (const double d = mismatch(centres[t], u, psi).norm(); d < least && centres[t].w < 0.5) {
      least = d;
      node.tet = t;
    }
  node.barycentric = Vec4::Constant(0.25);
  ControlNode best = node;
  for (int iteration = 0; iteration < 10 && least > 1e-6; ++iteration) {
    const CoordinateSample at = coordinates.sample(node.tet, node.barycentric);
    Mat3 gradient;
    gradient << at.grad_u.transpose(), at.grad_psi.transpose(), at.grad_t.transpose();
    const Vec3 step = gradient.partialPivLu().solve(
        Vec3(at.u - u, std::remainder(at.psi - psi, 2 * polyaffine::kPi), at.t - 0.5));
    const Vec3 X = polyaffine::position(mesh, node.tet, node.barycentric) - step;
    if (!X.allFinite()) break;
    const polyaffine::MeshPoint place = polyaffine::locate(mesh, X);
    node.tet = place.tet;
    node.barycentric = place.barycentric;
    const double d = mismatch(coordinates.sample(node.tet, node.barycentric), u, psi).norm();
    if (d >= least) continue;
    least = d;
    best = node;
  }
  best.position = coordinates.position(best.tet, best.barycentric);
  best.axes = orthonormal_axes(coordinates.sample(best.tet, best.barycentric));
  return best;
}

// A tet of the right free wall by its centre.
struct RightCentre {
  int tet = 0;
  CoordinateSample left;
  RightVentricularCoordinates::Sample right;
};

std::vector<RightCentre> right_centres(const polyaffine::TetMesh& mesh,
                                       const VentricularCoordinates& coordinates,
                                       const std::vector<CoordinateSample>& centres) {
  std::vector<RightCentre> out;
  const RightVentricularCoordinates* right = coordinates.right();
  for (int t = 0; right && t < mesh.num_tets(); ++t)
    if (right->border(t, Vec4::Constant(0.25)).share == 1)
      out.push_back({t, centres[t], right->sample(t, Vec4::Constant(0.25))});
  return out;
}

// The centre of the tet of the right free wall that comes closest to mid-wall at (u, ψ).
ControlNode find_right(const VentricularCoordinates& coordinates, const std::vector<RightCentre>& centres,
                       double u, double psi) {
  ControlNode node;
  node.barycentric = Vec4::Constant(0.25);
  double least = std::numeric_limits<double>::infinity();
  for (const RightCentre& at : centres) {
    const Vec3 away((at.left.u - u) / at.left.grad_u.norm(), (at.right.psi - psi) / at.right.grad_psi.norm(),
                    (at.right.t - 0.5) / at.right.grad_t.norm());
    if (away.norm() >= least) continue;
    least = away.norm();
    node.tet = at.tet;
  }
  node.position = coordinates.position(node.tet, node.barycentric);
  node.axes = orthonormal_axes(coordinates.wall_sample(node.tet, node.barycentric));
  return node;
}

}  // namespace

std::vector<ControlNode> control_nodes(const polyaffine::TetMesh& mesh,
                                       const VentricularCoordinates& coordinates, const FrameLayout& layout) {
  std::vector<CoordinateSample> centres;
  for (int t = 0; t < mesh.num_tets(); ++t) centres.push_back(coordinates.sample(t, Vec4::Constant(0.25)));
  std::vector<ControlNode> nodes;
  for (auto ring = layout.rings.rbegin(); ring != layout.rings.rend(); ++ring)
    for (int j = 0; j < ring->nodes; ++j)
      nodes.push_back(find(mesh, coordinates, centres, ring->u, ring->node_angle(j)));
  ControlNode cap;
  const polyaffine::MeshPoint place = polyaffine::locate(mesh, cap_node_position(coordinates, layout));
  cap.tet = place.tet;
  cap.barycentric = place.barycentric;
  cap.position = cap_node_position(coordinates, layout);
  cap.axes = cap_axes(coordinates);
  nodes.push_back(cap);
  const auto right = right_centres(mesh, coordinates, centres);
  for (auto row = layout.right.rbegin(); row != layout.right.rend(); ++row)
    for (int j = 0; j < row->nodes; ++j)
      nodes.push_back(find_right(coordinates, right, row->u, row->node_psi(j)));
  return nodes;
}

}  // namespace cardiac
