#include "cardiac/run/motion.hpp"

#include <Eigen/LU>
#include <algorithm>

#include <cardiac/model/vertex_displacement.hpp>
#include <cardiac/reduction/reduced_points.hpp>

namespace cardiac {

using polyaffine::Points;
using polyaffine::Vector;

Motion::Motion(const Ventricle& ventricle, const std::vector<ControlNode>& nodes,
               const std::vector<SegmentInfo>& segments, const Vector& c_ed)
    : anatomy_(*ventricle.anatomy),
      basis_(*ventricle.discretisation.basis),
      nested_(dynamic_cast<const polyaffine::NestedBasis*>(&basis_)),
      control_nodes_(nodes),
      points_(strain_points(anatomy_, ventricle.discretisation)),
      table_(polyaffine::deformation_table(told_by(), points_)),
      gauge_(*anatomy_.coordinates, points_),
      at_points_(told_by(), points_.tet, points_.barycentric),
      at_vertices_(vertex_displacement(anatomy_.mesh, told_by())),
      told_ed_(told(c_ed)),
      axes_ed_(gauge_.reference_axes(polyaffine::evaluate_field(table_, told_ed_))),
      points_ed_(gauge_.positions() + at_points_.apply(told_ed_)),
      vertices_ed_(vertices(told_ed_)),
      fit_(anatomy_.mesh, anatomy_.segment, nodes, vertices_ed_) {
  for (const SegmentInfo& segment : segments) volumes_.push_back(segment.volume_mL);
  contours_.push_back(contours(ContourGauge::Side::left));
  if (ventricle.cavities.size() > 1) contours_.push_back(contours(ContourGauge::Side::right));
}

const polyaffine::Basis& Motion::told_by() const {
  if (nested_) return nested_->elements();
  return basis_;
}

std::vector<Instant> Motion::instants(const std::vector<HeartState>& states) const {
  polyaffine::Matrix c(3 * basis_.num_functions(), std::ssize(states));
  for (Eigen::Index k = 0; k < c.cols(); ++k) c.col(k) = states[static_cast<std::size_t>(k)].c;
  const polyaffine::Matrix u = told(c);
  std::vector<Instant> out;
  for (Eigen::Index k = 0; k < u.cols(); ++k)
    out.push_back(instant(states[static_cast<std::size_t>(k)].time_ms, u.col(k)));
  return out;
}

Instant Motion::instant(double time_ms, const Vector& u) const {
  Instant out;
  out.time_ms = time_ms;
  const polyaffine::Matrix F = polyaffine::evaluate_field(table_, u);
  for (const auto& at : F.colwise())
    out.min_det_F = std::min(out.min_det_F, polyaffine::Mat3(at.reshaped(3, 3)).determinant());
  out.strain = gauge_.strain(F, axes_ed_);
  const Points x = vertices(u);
  out.frames = fit_.frames(x);
  const auto rotation = gauge_.rotation_deg(gauge_.positions() + at_points_.apply(u), points_ed_);
  out.global.push_back(global_strain(out.strain, rotation, volumes_));
  if (contours_.size() > 1) out.global.push_back(right_global_strain(out.strain, volumes_));
  for (std::size_t k = 0; k < contours_.size(); ++k) contours_[k].measure(x, out.global[k]);
  return out;
}

std::vector<SegmentNode> Motion::nodes() const {
  std::vector<SegmentNode> out;
  for (std::size_t k = 0; k < control_nodes_.size(); ++k)
    out.push_back({fit_.node_positions().col(static_cast<Eigen::Index>(k)), control_nodes_[k].axes});
  return out;
}

Points Motion::vertices(const Vector& u) const {
  return anatomy_.mesh.points() + at_vertices_.apply(u);
}

ContourGauge Motion::contours(ContourGauge::Side side) const {
  return {anatomy_.mesh, *anatomy_.coordinates, anatomy_.segment, anatomy_.labels, side, vertices_ed_};
}

}  // namespace cardiac
