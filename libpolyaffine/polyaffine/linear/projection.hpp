#pragma once

#include <memory>

#include <polyaffine/core/types.hpp>
#include <polyaffine/kinematics/basis.hpp>
#include <polyaffine/linear/linear_system.hpp>

namespace polyaffine {

/// Linear constraints C c = d on the unknowns.
struct LinearConstraints {
  Matrix C;  ///< constraints × unknowns
  Vector d;
};

/// Displacement u (3 × points, mm) prescribed at points of the mesh: three constraints a point, in order.
LinearConstraints displacement_constraints(const Basis& basis, const std::vector<int>& tet,
                                           const Eigen::Matrix4Xd& barycentric, const Points& u);

/// All c with C c = d, as c = c0 + Z y: c0 the shortest of them, Z an orthonormal basis of the null space of
/// C (unknowns × free), so that c0 ⟂ Z.
struct Projection {
  Vector c0;
  Matrix Z;
  int rank = 0;         ///< of C: independent constraints
  double residual = 0;  ///< ‖C c0 − d‖ / ‖d‖ (0 for d = 0)

  int num_free() const { return static_cast<int>(Z.cols()); }
  Vector expand(const Vector& y) const { return c0 + Z * y; }
  /// y of the admissible vector nearest to c.
  Vector reduce(const Vector& c) const { return Z.transpose() * c; }
};

/// Projection by complete orthogonal decomposition of C (Golub & Van Loan 2013, §5.4.7); pivots below
/// `tolerance` times the largest count as zero, so that constraints may repeat each other. Throws InputError
/// when the sizes differ, a number is not finite, or the constraints contradict each other (residual above
/// the square root of the tolerance).
Projection project(const LinearConstraints& constraints, double tolerance = 1e-12);

/// Dense system restricted to the null space: solve(r) = Z (ZᵀKZ)⁻¹ Zᵀ r, so that a Newton step keeps the
/// constraints. For System::projection.
std::unique_ptr<LinearSystem> projected_system(std::shared_ptr<const Projection> projection);

}  // namespace polyaffine
