#include "polyaffine/quadrature/weight_conditions.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>
#include <string>

#include <polyaffine/core/error.hpp>
#include <polyaffine/geometry/geodesic_regions.hpp>

namespace polyaffine {

WeightConditions stack(const WeightConditions& first, const WeightConditions& second) {
  if (first.A.cols() != second.A.cols())
    throw std::invalid_argument("weight conditions: found " + std::to_string(first.A.cols()) + " and " +
                                std::to_string(second.A.cols()) + " points, expected the same");
  WeightConditions out{Matrix(first.A.rows() + second.A.rows(), first.A.cols()),
                       Vector(first.b.size() + second.b.size()), Vector(first.b.size() + second.b.size())};
  out.A << first.A, second.A;
  out.b << first.b, second.b;
  out.scale << first.scale, second.scale;
  return out;
}

Points boundary_integrals(const Basis& basis, const SurfacePoints& boundary) {
  Points out = Points::Zero(3, basis.num_functions());
  for (Eigen::Index q = 0; q < boundary.weights.size(); ++q) {
    const BasisSample s = basis.sample(boundary.tet[q], boundary.barycentric.col(q));
    const Vec3 area = boundary.weights[q] * Vec3(boundary.X_xi.col(q)).cross(Vec3(boundary.X_eta.col(q)));
    for (std::size_t k = 0; k < s.functions.size(); ++k) {
      if (basis.in_local_axes(s.functions[k]))
        throw std::invalid_argument("boundary integrals: expected functions without local axes");
      out.col(s.functions[k]) += s.N[static_cast<Eigen::Index>(k)] * area;
    }
  }
  return out;
}

WeightConditions integration_constraint(const FieldTable& table, const Points& boundary_integrals) {
  WeightConditions out{
      Matrix::Zero(table.num_unknowns(), table.num_points()), boundary_integrals.reshaped(),
      Vector::Constant(table.num_unknowns(), boundary_integrals.colwise().norm().maxCoeff())};
  for (const PointBlock& block : table.blocks)
    for (const FunctionGroup& group : block.groups) {
      if (!group.lift.empty() || group.is_modes())
        throw std::invalid_argument(
            "integration constraint: expected functions without local axes and no modes");
      for (std::size_t a = 0; a < group.functions.size(); ++a)
        out.A.block(3 * group.functions[a], block.first, 3, block.count) =
            group.rows.row(static_cast<Eigen::Index>(a)).reshaped(3, block.count);
    }
  return out;
}

WeightConditions region_moments(const TetMesh& mesh, const std::vector<int>& label, int count,
                                const std::vector<int>& tet, const Points& X) {
  const Vector volume = region_volumes(mesh, label, count);
  if (!(volume.minCoeff() > 0)) throw InputError("region moments: found a region without tets");
  Points centre = Points::Zero(3, count);
  for (int t = 0; t < mesh.num_tets(); ++t)
    if (label[t] >= 0) centre.col(label[t]) += mesh.tet_volume(t) / volume[label[t]] * mesh.tet_centroid(t);
  WeightConditions out{Matrix::Zero(4 * count, X.cols()), Vector::Zero(4 * count), Vector(4 * count)};
  for (int r = 0; r < count; ++r) {
    out.b[4 * r] = volume[r];
    out.scale.segment<4>(4 * r) << volume[r], Vec3::Constant(volume[r] * std::cbrt(volume[r]));
  }
  for (Eigen::Index q = 0; q < X.cols(); ++q) {
    const int r = label[tet[q]];
    if (r < 0) continue;
    out.A(4 * r, q) = 1;
    out.A.block<3, 1>(4 * r + 1, q) = X.col(q) - centre.col(r);
  }
  return out;
}

}  // namespace polyaffine
