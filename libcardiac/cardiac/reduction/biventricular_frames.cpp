#include "cardiac/reduction/biventricular_frames.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include <cardiac/anatomy/segments.hpp>

namespace cardiac {

using polyaffine::FrameSample;
using polyaffine::FramesAtPoint;
using polyaffine::Vec3;
using polyaffine::Vec4;

BiventricularFrames::BiventricularFrames(std::shared_ptr<const VentricularCoordinates> coordinates,
                                         FrameLayout layout, bool base_frames)
    : SegmentFrames(coordinates, layout, base_frames),
      right_(*coordinates->right()),
      rows_(layout.right),
      first_base_(SegmentFrames::num_frames()) {
  RightRow base = rows_.back();
  base.u = 1;
  base.first_frame = first_base_;
  rows_.push_back(base);
  // Means over the right free wall and over its lowest part.
  const auto& space = coordinates->space();
  double volume = 0, inverse = 0, apex_volume = 0;
  for (int t = 0; t < static_cast<int>(space.elements().cols()); ++t) {
    const Vec4 centre = Vec4::Constant(0.25);
    if (right_.border(t, centre).w < 0.5) continue;
    const double v = space.jacobian(t, centre).determinant();
    const Vec3 X = space.position(t, centre);
    const CoordinateSample at = coordinates->sample(t, centre);
    volume += v;
    inverse += v * at.grad_u.norm();
    if (at.u > rows_[0].u) continue;
    apex_volume += v;
    apex_ += v * X;
  }
  length_mm_ = volume / inverse;
  if (apex_volume > 0) apex_ /= apex_volume;
}

bool BiventricularFrames::is_right(int frame) const {
  return (frame > layout().cap() && frame < layout().num_nodes()) || frame >= first_base_;
}

BiventricularFrames::Interval BiventricularFrames::interval(double u) const {
  const std::size_t last = rows_.size() - (base_frames() ? 1 : 2);
  if (u <= rows_[0].u) return {0, 0, 0};
  if (u >= rows_[last].u) return {last - 1, 1, 0};
  std::size_t k = 0;
  while (k + 1 < last && u > rows_[k + 1].u) ++k;
  const double width = rows_[k + 1].u - rows_[k].u;
  return {k, (u - rows_[k].u) / width, 1 / width};
}

void BiventricularFrames::add_right(const CoordinateSample& at,
                                    const RightVentricularCoordinates::Sample& right, const Vec3& X,
                                    double factor, const Vec3& factor_gradient,
                                    std::vector<FrameSample>& frames) const {
  const double unit = layout().length;
  const double round = layout().right_radius * right_.half_angle();  // mm for a unit of ψ
  const auto add_row = [&](std::size_t k, double share, double slope) {
    const RightRow& row = rows_[k];
    const double place = std::clamp((right.psi - row.node_psi(0)) / row.step(), 0.0, row.nodes - 1.0);
    const int below = std::min(static_cast<int>(place), row.nodes - 1);
    for (int j = below; j <= std::min(below + 1, row.nodes - 1); ++j) {
      const double hat = 1 - std::abs(place - j);
      if (hat <= 0) continue;
      const bool inside = place > 0 && place < row.nodes - 1;
      const Vec3 hat_gradient =
          inside ? Vec3((j == below ? -1 : 1) / row.step() * right.grad_psi) : Vec3::Zero();
      FrameSample f;
      f.frame = row.first_frame + j;
      f.weight = factor * share * hat;
      f.weight_gradient =
          share * hat * factor_gradient + factor * (slope * hat * at.grad_u + share * hat_gradient);
      if (row.nodes == 1) {
        const polyaffine::Mat3 axes = cap_axes(coordinates());
        f.xi = axes.transpose() * (X - apex_) / unit;
        f.xi_gradient = axes.transpose() / unit;
      } else {
        f.xi = Vec3(length_mm_ * (at.u - row.u), round * (right.psi - row.node_psi(j)),
                    layout().right_thickness * (right.t - 0.5)) /
               unit;
        f.xi_gradient << length_mm_ / unit * at.grad_u.transpose(), round / unit * right.grad_psi.transpose(),
            layout().right_thickness / unit * right.grad_t.transpose();
      }
      frames.push_back(f);
    }
  };
  const Interval at_u = interval(at.u);
  if (at_u.share < 1) add_row(at_u.lower, 1 - at_u.share, -at_u.slope);
  if (at_u.share > 0) add_row(at_u.lower + 1, at_u.share, at_u.slope);
}

FramesAtPoint BiventricularFrames::sample(int tet, const Vec4& barycentric) const {
  const auto border = right_.border(tet, barycentric);
  if (border.share == 0) return SegmentFrames::sample(tet, barycentric);
  FramesAtPoint out;
  if (border.share < 1) {
    out = SegmentFrames::sample(tet, barycentric);
    for (FrameSample& f : out.frames) {
      f.weight_gradient = (1 - border.share) * f.weight_gradient - f.weight * border.share_gradient;
      f.weight *= 1 - border.share;
    }
  }
  const CoordinateSample at = coordinates().sample(tet, barycentric);
  add_right(at, right_.sample(tet, barycentric), coordinates().position(tet, barycentric), border.share,
            border.share_gradient, out.frames);
  return out;
}

// Cells of the left frames, of the right ones, and of both where both act, one for each pair.
SegmentFrames::PointCell BiventricularFrames::point_cell(int tet, const Vec4& barycentric) const {
  const double switched = right_.border(tet, barycentric).share;
  const PointCell left = SegmentFrames::point_cell(tet, barycentric);
  if (switched == 0) return left;
  const double u = coordinates().sample(tet, barycentric).u;
  const auto right = right_.sample(tet, barycentric);
  const Interval at_u = interval(u);
  constexpr int kSectors = 16;  // at most, between the nodes of two rows
  std::vector<double> breaks{-1};
  for (std::size_t k = at_u.lower; k < std::min(at_u.lower + 2, rows_.size()); ++k)
    for (int j = 0; j < rows_[k].nodes; ++j) breaks.push_back(rows_[k].node_psi(j));
  std::sort(breaks.begin(), breaks.end());
  breaks.push_back(1);
  const auto above = std::clamp<std::ptrdiff_t>(
      std::upper_bound(breaks.begin(), breaks.end(), right.psi) - breaks.begin(), 1, std::ssize(breaks) - 1);
  const double width = std::max(breaks[above] - breaks[above - 1], 1e-9);
  const int sector = static_cast<int>(at_u.lower) * kSectors + static_cast<int>(above);
  const double place = std::clamp((right.psi - breaks[above - 1]) / width, 0.0, 1.0);
  if (switched == 1) return {num_cells() + sector, {at_u.share, place, right.t}};
  const int sectors = kSectors * static_cast<int>(rows_.size());
  return {num_cells() + sectors * (1 + left.index) + sector, {left.place[0], switched, right.t}};
}

}  // namespace cardiac
