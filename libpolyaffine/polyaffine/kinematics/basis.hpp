#pragma once

#include <array>
#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/kinematics/field_table.hpp>

namespace polyaffine {

/// The functions that do not vanish at one point. Functions in local axes give u = Q Σ c_a N_a with the axes
/// Q(X) (columns) and dQ[J] = ∂Q/∂X_J; all functions of a point share the same Q.
struct BasisSample {
  /// Three vector functions that share one vector coefficient: u = [m_1 m_2 m_3] c.
  struct Modes {
    int function = 0;
    Mat3 value;                            ///< columns m_k
    Eigen::Matrix<double, 9, 3> gradient;  ///< columns ∇m_k, column-major, 1/mm
  };

  std::vector<int> functions;
  Vector N;
  Points gradient;  ///< ∇N_a, 3 × functions, 1/mm
  Mat3 Q = Mat3::Identity();
  std::array<Mat3, 3> dQ{Mat3::Zero(), Mat3::Zero(), Mat3::Zero()};
  std::vector<Modes> modes;  ///< numbered as the functions are
};

/// A set of shape functions with vector coefficients over a tetrahedral mesh: u(X) = Σ_a c_a N_a(X), Q(X) Σ_a
/// c_a N_a(X) for the functions in local axes, or Σ_a [m_a1 m_a2 m_a3] c_a for modes, vector functions of
/// which three make one. Finite elements and reduced frames are such sets.
class Basis {
 public:
  virtual ~Basis() = default;
  virtual int num_functions() const = 0;
  /// Evaluates at barycentric coordinates of a tet.
  virtual BasisSample sample(int tet, const Vec4& barycentric) const = 0;
  virtual bool in_local_axes(int /*function*/) const { return false; }
};

/// Points of the wall, grouped into the blocks of a field table: block k is [starts[k], starts[k+1]).
struct WallPoints {
  std::vector<int> tet;
  Eigen::Matrix4Xd barycentric;
  Vector weights;  ///< mm³
  std::vector<int> starts;
};

/// Points of a surface with position, tangents (for a surface integral ∫ f dξdη the weights hold dξdη) and
/// blocks.
struct SurfacePoints {
  std::vector<int> tet;
  Eigen::Matrix4Xd barycentric;
  Vector weights;
  Points X, X_xi, X_eta;  ///< mm; X_ξ × X_η points out of the wall
  std::vector<int> starts;
};

/// The deformation gradient F = I + Σ c_a ⊗ ∇N_a (with local axes: I + Q Σ c_a ⊗ ∇N_a + ∂Q·Σ c_a N_a; of
/// modes I + Σ_k c_ak ∇m_ak) at the points.
FieldTable deformation_table(const Basis& basis, const WallPoints& points);

/// M = [x − origin, x_ξ, x_η] on a surface. With SignedVolume of factor 1/3 it integrates to the volume
/// between the surface and the cone from its rim to the origin, positive where X_ξ × X_η points away from the
/// origin.
FieldTable surface_table(const Basis& basis, const SurfacePoints& points, const Vec3& origin);

/// M = [u, 0, 0] on a surface, the weights being areas (mm²): for springs and dead forces.
FieldTable displacement_table(const Basis& basis, const SurfacePoints& points);

/// M = [u, 0, 0] in the body, the weights being volumes (mm³): for inertia and forces of volume.
FieldTable displacement_table(const Basis& basis, const WallPoints& points);

/// Displacement at points, 3 × points, mm.
class DisplacementMap {
 public:
  DisplacementMap(const Basis& basis, const std::vector<int>& tet, const Eigen::Matrix4Xd& barycentric);
  Points apply(const Vector& c) const;
  /// The exact transpose: generalised force Σ_p f_p N_a(X_p) (in local axes Qᵀf) of forces at the points, mN.
  Vector transpose(const Points& forces) const;

 private:
  int num_functions_;
  std::vector<int> start_, functions_;
  std::vector<double> N_;
  std::vector<char> local_;
  std::vector<Mat3> axes_;
  std::vector<int> mode_start_, mode_functions_;
  std::vector<Mat3> modes_;
};

}  // namespace polyaffine
