#pragma once

#include <string>
#include <vector>

#include <cardiac/model/ventricle.hpp>
#include <cardiac/protocol/protocol.hpp>
#include <polyaffine/geometry/locate.hpp>

namespace cardiac {

/// The truncated ellipsoid of the poly-affine paper on one mesh: the ventricle of Land et al. in mm,
/// isochoric neo-Hookean with κ/2 (J − 1)², E = 10⁶ kPa, ν = 0.49 (strains are about 10⁻³), 1000 N of
/// pressure in all on its endocardium, base fixed.
class EllipsoidProblem {
 public:
  explicit EllipsoidProblem(const polyaffine::TetMesh& mesh);

  const Anatomy& anatomy() const { return *anatomy_; }
  double pressure_kPa() const { return pressure_; }
  /// The protocol with settings key=value on top.
  Protocol protocol(const std::vector<std::string>& settings) const;

  struct Solution {
    Ventricle ventricle;
    polyaffine::Vector c;
    double solve_s = 0;  ///< median of the repetitions
    bool converged = false;

    /// Displacement (3 × points, mm) at places of the mesh.
    polyaffine::Points displacement(const std::vector<polyaffine::MeshPoint>& at) const;
  };
  /// Settings say by which model.
  Solution solve(const std::vector<std::string>& settings, int repetitions = 1) const;

  /// How the base of a model with tents is held when its base frames carry every function of the others.
  /// With a stiffness: by springs over the base (kPa/mm); zero: by the projective constraint, displacement
  /// zero at all nodes of the base.
  Solution solve_held(const std::vector<std::string>& settings, double stiffness_kPa_per_mm) const;

  /// Places of positions in the curved elements.
  std::vector<polyaffine::MeshPoint> locate(const polyaffine::Points& X) const;
  /// Mean of |∂u/∂z| over the base.
  double base_slope(const Solution& solution) const;
  /// Largest displacement of the base, mm.
  double base_motion(const Solution& solution) const;

 private:
  Solution solve(Ventricle ventricle, const std::shared_ptr<const polyaffine::Projection>& projection,
                 int repetitions) const;

  std::shared_ptr<const Anatomy> anatomy_;
  double pressure_ = 0;
};

/// Points of the outer surface in the half plane (x⁺, 0, z), apex to base, 3 × n, mm.
polyaffine::Points outer_meridian(int n);

/// Radial part of displacements at positions: away from the z axis and the apex, along the ellipsoid's
/// normal.
polyaffine::Vector normal_part(const polyaffine::Points& X, const polyaffine::Points& u);

}  // namespace cardiac
