#include "cardiac/reduction/biventricular_frames.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include <cardiac/anatomy/segments.hpp>

namespace cardiac {

using polyaffine::FrameSample;
using polyaffine::FramesAtPoint;
using polyaffine::Vec3;
using polyaffine::Vec4;

namespace {

// A row of nodes has at most four (frame_layout), so that the nodes of two rows and the ends part the right
// wall into nine sectors at most; cells are numbered with room for this many in each interval of rows.
constexpr int kSectors = 16;
// Sectors are at least this wide in ψ: where two rows have a node at the same place, the one between them is
// empty.
constexpr double kNarrowestSector = 1e-9;

}  // namespace

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

// Local coordinates of a node of a row: about the wall, or, of the single node at the apex, Cartesian ones.
void BiventricularFrames::set_local(const RightRow& row, int node, const RightPoint& at,
                                    FrameSample& f) const {
  const double unit = layout().length;
  if (row.nodes == 1) {
    const polyaffine::Mat3 axes = cap_axes(coordinates());
    f.xi = axes.transpose() * (at.X - apex_) / unit;
    f.xi_gradient = axes.transpose() / unit;
    return;
  }
  const double round = layout().right_radius * right_.half_angle();  // mm for a unit of ψ
  f.xi = Vec3(length_mm_ * (at.left.u - row.u), round * (at.right.psi - row.node_psi(node)),
              layout().right_thickness * (at.right.t - 0.5)) /
         unit;
  f.xi_gradient << length_mm_ / unit * at.left.grad_u.transpose(),
      round / unit * at.right.grad_psi.transpose(),
      layout().right_thickness / unit * at.right.grad_t.transpose();
}

// The frames of row k at a point: σ R(u) C_j(ψ), with the share σ of the right ventricle, R = share along the
// wall and tents C_j between the nodes, which stay 1 from the outer nodes to the borders of the free wall.
void BiventricularFrames::add_row(std::size_t k, double share, double slope, const RightPoint& at,
                                  std::vector<FrameSample>& frames) const {
  const RightRow& row = rows_[k];
  const double place = std::clamp((at.right.psi - row.node_psi(0)) / row.step(), 0.0, row.nodes - 1.0);
  const bool between_nodes = place > 0 && place < row.nodes - 1;
  const int below = std::min(static_cast<int>(place), row.nodes - 1);
  for (int j = below; j <= std::min(below + 1, row.nodes - 1); ++j) {
    const double hat = 1 - std::abs(place - j);
    if (hat <= 0) continue;
    Vec3 hat_gradient = Vec3::Zero();
    if (between_nodes) hat_gradient = (j == below ? -1 : 1) / row.step() * at.right.grad_psi;
    FrameSample f;
    f.frame = row.first_frame + j;
    f.weight = at.border.share * share * hat;
    f.weight_gradient = share * hat * at.border.share_gradient +
                        at.border.share * (slope * hat * at.left.grad_u + share * hat_gradient);
    set_local(row, j, at, f);
    frames.push_back(f);
  }
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
  const RightPoint at{coordinates().position(tet, barycentric), coordinates().sample(tet, barycentric),
                      right_.sample(tet, barycentric), border};
  const Interval rows = interval(at.left.u);
  if (rows.share < 1) add_row(rows.lower, 1 - rows.share, -rows.slope, at, out.frames);
  if (rows.share > 0) add_row(rows.lower + 1, rows.share, rows.slope, at, out.frames);
  return out;
}

BiventricularFrames::Sector BiventricularFrames::sector(std::size_t lower, double psi) const {
  std::vector<double> breaks{-1};
  for (std::size_t k = lower; k < std::min(lower + 2, rows_.size()); ++k)
    for (int j = 0; j < rows_[k].nodes; ++j) breaks.push_back(rows_[k].node_psi(j));
  std::sort(breaks.begin(), breaks.end());
  breaks.push_back(1);
  const auto above = std::clamp<std::ptrdiff_t>(
      std::upper_bound(breaks.begin(), breaks.end(), psi) - breaks.begin(), 1, std::ssize(breaks) - 1);
  const double width = std::max(breaks[above] - breaks[above - 1], kNarrowestSector);
  return {static_cast<int>(lower) * kSectors + static_cast<int>(above),
          std::clamp((psi - breaks[above - 1]) / width, 0.0, 1.0)};
}

bool BiventricularFrames::at_apex(int cell) const {
  if (cell < num_cells()) return SegmentFrames::at_apex(cell);
  const int right_cells = kSectors * static_cast<int>(rows_.size());
  return (cell - num_cells()) % right_cells < kSectors;  // of the lowest rows
}

// Cells are numbered in this order: those of the left frames; those of the right ones; and those in which
// both act, one for each pair of a left cell and a right one.
SegmentFrames::PointCell BiventricularFrames::point_cell(int tet, const Vec4& barycentric) const {
  const double share_of_right = right_.border(tet, barycentric).share;
  const PointCell left = SegmentFrames::point_cell(tet, barycentric);
  if (share_of_right == 0) return left;
  const auto right = right_.sample(tet, barycentric);
  const Interval rows = interval(coordinates().sample(tet, barycentric).u);
  const Sector own = sector(rows.lower, right.psi);
  if (share_of_right == 1) return {num_cells() + own.number, {rows.share, own.place, right.t}};
  const int right_cells = kSectors * static_cast<int>(rows_.size());
  return {num_cells() + right_cells * (1 + left.index) + own.number,
          {left.place[0], share_of_right, right.t}};
}

std::shared_ptr<const SegmentFrames> tent_frames(std::shared_ptr<const VentricularCoordinates> coordinates,
                                                 const FrameLayout& layout, bool base_frames) {
  if (coordinates->right())
    return std::make_shared<BiventricularFrames>(std::move(coordinates), layout, base_frames);
  return std::make_shared<SegmentFrames>(std::move(coordinates), layout, base_frames);
}

}  // namespace cardiac
