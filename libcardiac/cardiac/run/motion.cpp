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
      control_nodes_(nodes),
      points_(strain_points(anatomy_, ventricle.discretisation)),
      table_(polyaffine::deformation_table(*ventricle.discretisation.basis, points_)),
      gauge_(*anatomy_.coordinates, points_),
      at_points_(*ventricle.discretisation.basis, points_.tet, points_.barycentric),
      at_vertices_(vertex_displacement(ventricle)),
      axes_ed_(gauge_.reference_axes(polyaffine::evaluate_field(table_, c_ed))),
      points_ed_(gauge_.positions() + at_points_.apply(c_ed)),
      vertices_ed_(vertices(c_ed)),
      fit_(anatomy_.mesh, anatomy_.segment, nodes, vertices_ed_) {
  for (const SegmentInfo& segment : segments) volumes_.push_back(segment.volume_mL);
  contours_.push_back(contours(ContourGauge::Side::left));
  if (ventricle.cavities.size() > 1) contours_.push_back(contours(ContourGauge::Side::right));
}

Instant Motion::instant(double time_ms, const Vector& c) const {
  Instant out;
  out.time_ms = time_ms;
  const polyaffine::Matrix F = polyaffine::evaluate_field(table_, c);
  for (const auto& at : F.colwise())
    out.min_det_F = std::min(out.min_det_F, polyaffine::Mat3(at.reshaped(3, 3)).determinant());
  out.strain = gauge_.strain(F, axes_ed_);
  const Points x = vertices(c);
  out.frames = fit_.frames(x);
  const auto rotation = gauge_.rotation_deg(gauge_.positions() + at_points_.apply(c), points_ed_);
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

Points Motion::vertices(const Vector& c) const {
  return anatomy_.mesh.points() + at_vertices_.apply(c);
}

ContourGauge Motion::contours(ContourGauge::Side side) const {
  return {anatomy_.mesh, *anatomy_.coordinates, anatomy_.segment, anatomy_.labels, side, vertices_ed_};
}

}  // namespace cardiac
