#pragma once

#include <vector>

#include <cardiac/core/beat_result.hpp>
#include <cardiac/reduction/control_nodes.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace cardiac {

/// The affine map of each segment that comes closest to the motion of its material since end diastole.
///
/// With y the end-diastolic position of a material point and x its position now (both linear in every tet of
/// the mesh, between its vertices), q the end-diastolic position of the segment's control node and R its axes
/// in the mesh (columns longitudinal, circumferential, radial), A and t make
///   ∫ |x − q − R (A Rᵀ (y − q) + t)|² dV
/// least, dV the volume in the mesh and the integral over the tets of the segment; at end diastole A = I and
/// t = 0. Integrals are exact. The misfit is the share of the motion that no affine map holds, √(∫ |x − q −
/// R (A Rᵀ (y − q) + t)|² dV / ∫ |x − y|² dV), from 0 (affine) to 1; NaN where the segment has not moved.
///
/// A segment is bent: part of its extent along the radial axis is its own curvature, which shortens with the
/// circumference while the wall thickens. The determinant of A is then not the change of its volume (that is
/// SegmentStrain::volume_ratio): it lies below it in systole and above it in an inflation, by up to 0.2 in a
/// left ventricle and 0.35 in the thin right free wall of the shipped hearts. Equal determinants would cost
/// up to a seventh of the misfit.
class AffineFit {
 public:
  /// `segment`: number (from 1) of the segment of each tet; a node for each segment. `x_ed`: end-diastolic
  /// positions of the vertices, mm (without a beat: those of the mesh).
  AffineFit(const polyaffine::TetMesh& mesh, const std::vector<int>& segment,
            const std::vector<ControlNode>& nodes, const polyaffine::Points& x_ed);

  /// The maps to the positions x of the vertices (3 × points, mm), one a segment.
  std::vector<SegmentFrame> frames(const polyaffine::Points& x) const;

  /// End-diastolic positions q of the control nodes, 3 × segments, mm.
  const polyaffine::Points& node_positions() const { return q_; }

 private:
  struct Segment {
    polyaffine::Mat3 axes;
    std::vector<int> vertices;
    Eigen::Matrix4Xd p;     ///< (Rᵀ (y − q), 1) of the vertices
    Eigen::Matrix4Xd dual;  ///< the fit is linear: [A − I, t] = Σ_v Rᵀ(x − y)_v dual_vᵀ
    Eigen::Matrix4Xi tets;  ///< corners, counted in `vertices`
    polyaffine::Vector volumes;
  };
  static SegmentFrame fit(const Segment& segment, const polyaffine::Points& u);

  polyaffine::Points x_ed_, q_;
  std::vector<Segment> segments_;
};

}  // namespace cardiac
