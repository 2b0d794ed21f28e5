#pragma once

#include <optional>

#include <cardiac/validation/cube_scene.hpp>
#include <polyaffine/linear/projection.hpp>
#include <polyaffine/system/system.hpp>

namespace cardiac {

/// What the paper measures: the change of thickness by planes fitted to the vertical displacement of top and
/// bottom. Rigid motions do not count.
struct CubeThickness {
  double change = 0;   ///< top minus bottom, mm
  double slope_x = 0;  ///< how much more the cube changes from one side to the other, mm
  double slope_y = 0;
  double tilt() const;  ///< largest deviation from `change` over the face, mm: half of both slopes
};

CubeThickness operator-(const CubeThickness& a, const CubeThickness& b);

/// Free-sided compression, held without force at three corners; the same code for finite elements and frames.
struct CubeSolution {
  CubeThickness thickness;
  double solve_s = 0;  ///< processor time of assembly and Newton's method, the quickest of `repeats`
};

/// Linear tetrahedra: the paper's reference.
CubeSolution solve_cube_fem(const CubeScene& scene, int repeats);

enum class CubeKinematics { blending, gmls };
enum class CubeWeights { volumes, consistent };

struct CubeMethod {
  CubeKinematics kinematics = CubeKinematics::blending;
  int elaston_order = 0;  ///< 0: one point an integration region, 1: four points with its moments
  bool operator==(const CubeMethod&) const = default;
};

/// A placement made ready for one method, solved with either kind of weights.
class CubeReduction {
 public:
  CubeReduction(const CubeScene& scene, const CubePlacement& placement, const CubeMethod& method);

  CubeSolution solve(CubeWeights weights, int repeats) const;
  /// ‖Σ_q w_q ∇N_a − ∮ N_a n dA‖ over all functions for the volumes as weights, relative to the largest
  /// boundary integral.
  double defect() const { return relative_defect_; }
  /// Thickness error caused by the spurious forces σ·(Σ_q w_q ∇N_a − ∮ N_a n dA) of the volumes as weights.
  CubeThickness defect_response() const;

  bool is_consistent() const { return is_consistent_; }  ///< there are consistent weights for these points
  bool keeps_moments() const { return keeps_moments_; }  ///< of every zone, in the consistent weights
  double setup_s() const { return setup_s_; }            ///< processor time of weights and tables
  double correction_s() const { return correction_s_; }  ///< and of the consistent weights

 private:
  polyaffine::System system(CubeWeights weights) const;
  CubeThickness measure(const polyaffine::Vector& c) const;

  polyaffine::FieldTable table_;               ///< with the volumes as weights
  std::vector<polyaffine::FieldTable> loads_;  ///< bottom, top
  std::shared_ptr<const polyaffine::Projection> supports_;
  polyaffine::SurfacePoints bottom_, top_;
  std::optional<polyaffine::DisplacementMap> bottom_map_, top_map_;
  polyaffine::Vector consistent_, defect_;
  double relative_defect_ = 0;
  bool is_consistent_ = false, keeps_moments_ = false;
  double setup_s_ = 0, correction_s_ = 0;
};

/// Exact change of thickness, −p h / E, mm.
double exact_thickness_change();

}  // namespace cardiac
