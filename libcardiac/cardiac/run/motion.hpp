#pragma once

#include <vector>

#include <cardiac/core/heart_state.hpp>
#include <cardiac/model/ventricle.hpp>
#include <cardiac/strain/affine_fit.hpp>
#include <cardiac/strain/contour_gauge.hpp>
#include <cardiac/strain/segment_strain.hpp>
#include <polyaffine/kinematics/nested_basis.hpp>

namespace cardiac {

/// The motion of a ventricle since end diastole as it is told: strain of the segments (SegmentGauge), their
/// affine maps (AffineFit) and the global strain of each ventricle (global_strain, ContourGauge). All that
/// does not change with time is computed once; a model that is nested in elements is told by their functions.
/// The ventricle must outlive the motion.
class Motion {
 public:
  /// `c_ed`: the end-diastolic coefficients of the wall; a node and an entry of `segments` for each segment.
  Motion(const Ventricle& ventricle, const std::vector<ControlNode>& nodes,
         const std::vector<SegmentInfo>& segments, const polyaffine::Vector& c_ed);

  /// The states, without unknowns of frames; global strain of the left ventricle and, where there is a right
  /// cavity, of the right one.
  std::vector<Instant> instants(const std::vector<HeartState>& states) const;

  /// The control nodes at end diastole.
  std::vector<SegmentNode> nodes() const;

 private:
  // Coefficients of the functions that a motion is told by, a column a state.
  polyaffine::Matrix told(const polyaffine::Matrix& c) const {
    return nested_ ? nested_->nodal_of_each(c) : c;
  }
  const polyaffine::Basis& told_by() const;
  Instant instant(double time_ms, const polyaffine::Vector& u) const;
  polyaffine::Points vertices(const polyaffine::Vector& u) const;
  ContourGauge contours(ContourGauge::Side side) const;

  const Anatomy& anatomy_;
  const polyaffine::Basis& basis_;
  const polyaffine::NestedBasis* nested_;  // null unless the model is nested in elements
  const std::vector<ControlNode>& control_nodes_;
  polyaffine::WallPoints points_;
  polyaffine::FieldTable table_;
  SegmentGauge gauge_;
  polyaffine::DisplacementMap at_points_, at_vertices_;
  polyaffine::Vector told_ed_;
  std::vector<polyaffine::Mat3> axes_ed_;
  polyaffine::Points points_ed_, vertices_ed_;
  AffineFit fit_;
  std::vector<double> volumes_;  ///< of the segments
  std::vector<ContourGauge> contours_;
};

}  // namespace cardiac
