#pragma once

#include <limits>
#include <vector>

#include <cardiac/model/ventricle.hpp>
#include <cardiac/strain/segment_strain.hpp>
#include <polyaffine/kinematics/element_locator.hpp>

namespace cardiac {

/// The elements that hold the material points of a ventricle, full order or reduced.
const polyaffine::LagrangeBasis& material_elements(const Ventricle& ventricle);

/// Displacement (3 × points, mm) and deformation gradient (9 × points).
struct WallState {
  polyaffine::Points u;
  polyaffine::Matrix F;
};

/// The state of a model with coefficients c at places of its elements.
WallState wall_state(const polyaffine::Basis& basis, const polyaffine::Vector& c,
                     const std::vector<polyaffine::MeshPoint>& at);

/// How far one solution is from a reference.
struct ModelErrors {
  double displacement_percent = 0;   ///< 100 ‖u − v‖ / ‖u‖, L2 over the reference's wall
  double volume_percent = 0;         ///< cavity volume against the reference's, signed
  double max_segment_strain = 0;     ///< Green–Lagrange normal strains, segments 1–16
  double apex_strain = 0;            ///< the same in segment 17
  double compliance_ratio = 0;       ///< change of the cavity's volume over the reference's
  double rv_volume_percent = kNone;  ///< of the right cavity, signed; NaN with one ventricle
  double right_strain = kNone;       ///< normal strains, segments 18–29; NaN with one ventricle

  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
};

/// Compares solutions with a reference at the reference's integration points, which are looked up in the
/// curved elements of the other mesh. Segments and their axes are those of the reference's coordinates.
class Yardstick {
 public:
  /// The reference must outlive it.
  Yardstick(const Ventricle& reference, const polyaffine::Vector& c);

  ModelErrors errors(const Ventricle& model, const polyaffine::Vector& c) const;
  /// The same of a state given at positions() with the cavity volumes at rest and deformed, mm³.
  ModelErrors errors(const WallState& state, double cavity_at_rest, double cavity) const;

  const polyaffine::Points& positions() const { return gauge_.positions(); }

 private:
  polyaffine::WallPoints points_;
  SegmentGauge gauge_;
  WallState state_;
  std::vector<polyaffine::Mat3> strain_;
  double cavity_at_rest_, cavity_, right_cavity_ = 0;
};

}  // namespace cardiac
