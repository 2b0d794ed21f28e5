#include "cardiac/reduction/segment_frames.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cardiac {

using polyaffine::FrameSample;
using polyaffine::FramesAtPoint;
using polyaffine::kPi;
using polyaffine::Vec3;
using polyaffine::Vec4;

namespace {

// In [0, 2π).
double positive_angle(double psi) {
  const double angle = std::fmod(psi, 2 * kPi);
  return angle < 0 ? angle + 2 * kPi : angle;
}

}  // namespace

polyaffine::Mat3 cap_axes(const VentricularCoordinates& c) {
  polyaffine::Mat3 axes;
  axes << c.anterior(), c.axis().cross(c.anterior()), -c.axis();
  return axes;
}

Vec3 cap_node_position(const VentricularCoordinates& c, const FrameLayout& layout) {
  return c.base_centre() - (c.cavity_length() + layout.cap_thickness / 2) * c.axis();
}

SegmentFrames::SegmentFrames(std::shared_ptr<const VentricularCoordinates> coordinates, FrameLayout layout,
                             bool base_frames)
    : coordinates_(std::move(coordinates)),
      layout_(std::move(layout)),
      base_frames_(base_frames),
      cap_axes_(cap_axes(*coordinates_)),
      cap_node_(cap_node_position(*coordinates_, layout_)) {
  const auto& rings = layout_.rings;
  positions_.push_back(0);
  for (const FrameRing& ring : rings) positions_.push_back(ring.u);
  positions_.push_back(1);
  cell_start_.push_back(0);
  for (std::size_t interval = 0; interval <= rings.size(); ++interval) {
    std::vector<double> breaks;
    const auto add = [&](const FrameRing& ring) {
      for (int j = 0; j < ring.nodes; ++j) breaks.push_back(positive_angle(ring.node_angle(j)));
    };
    if (interval > 0) add(rings[interval - 1]);
    if (interval < rings.size()) add(rings[interval]);
    std::sort(breaks.begin(), breaks.end());
    breaks.erase(std::unique(breaks.begin(), breaks.end(), [](double a, double b) { return b - a < 1e-9; }),
                 breaks.end());
    if (breaks.front() + 2 * kPi - breaks.back() < 1e-9) breaks.pop_back();
    cell_start_.push_back(cell_start_.back() + static_cast<int>(breaks.size()));
    breaks_.push_back(std::move(breaks));
  }
}

FramesAtPoint SegmentFrames::sample(int tet, const Vec4& barycentric) const {
  const CoordinateSample at = coordinates_->sample(tet, barycentric);
  const Vec3 X = coordinates_->position(tet, barycentric);
  FramesAtPoint out;
  out.Q = at.Q;
  out.dQ = at.dQ;

  const auto add_cap = [&](double weight, double slope) {
    FrameSample f{layout_.cap(), weight, slope * at.grad_u, {}, {}};
    f.xi = cap_axes_.transpose() * (X - cap_node_) / layout_.length;
    f.xi_gradient = cap_axes_.transpose() / layout_.length;
    out.frames.push_back(f);
  };
  // k = 0 the first ring, …, that of the base frames last.
  const auto add_ring = [&](std::size_t k, double weight, double slope) {
    const bool base = k == layout_.rings.size();
    const FrameRing& ring = base ? layout_.rings.back() : layout_.rings[k];
    const double step = ring.step();
    const double place = (at.psi - ring.angle) / step;
    const int below = static_cast<int>(std::floor(place));
    const Vec3 scale = Vec3(coordinates_->arc_length(), ring.radius, ring.thickness) / layout_.length;
    for (int side = 0; side < 2; ++side) {
      const int j = below + side;
      const double hat = 1 - std::abs(place - j);
      const double hat_slope = (side == 0 ? -1 : 1) / step;
      FrameSample f;
      f.frame = (base ? layout_.num_nodes() : ring.first_frame) + (j % ring.nodes + ring.nodes) % ring.nodes;
      f.weight = weight * hat;
      f.weight_gradient = slope * hat * at.grad_u + weight * hat_slope * at.grad_psi;
      f.xi = scale.cwiseProduct(Vec3(at.u - positions_[k + 1],
                                     std::remainder(at.psi - ring.angle - j * step, 2 * kPi), at.t - 0.5));
      f.xi_gradient << scale[0] * at.grad_u.transpose(), scale[1] * at.grad_psi.transpose(),
          scale[2] * at.grad_t.transpose();
      out.frames.push_back(f);
    }
  };

  const std::size_t last = base_frames_ ? positions_.size() - 1 : positions_.size() - 2;
  std::size_t k = 0;
  while (k + 1 < last && at.u > positions_[k + 1]) ++k;
  const double width = positions_[k + 1] - positions_[k];
  // Without base frames the basal ring reaches up to the base; quadratic interpolation may pass 0 and 1 by a
  // little.
  const bool beyond = at.u <= 0 || at.u >= positions_[last];
  const double upper = std::clamp((at.u - positions_[k]) / width, 0.0, 1.0);
  const double slope = beyond ? 0.0 : 1 / width;
  if (upper < 1) {
    if (k == 0)
      add_cap(1 - upper, -slope);
    else
      add_ring(k - 1, 1 - upper, -slope);
  }
  if (upper > 0) add_ring(k, upper, slope);
  return out;
}

SegmentFrames::PointCell SegmentFrames::point_cell(int tet, const Vec4& barycentric) const {
  const CoordinateSample at = coordinates_->sample(tet, barycentric);
  const Cell c = cell(at.u, at.psi);
  return {c.index, Vec3(c.u, c.psi, at.t)};
}

SegmentFrames::Cell SegmentFrames::cell(double u, double psi) const {
  std::size_t k = 0;
  while (k + 2 < positions_.size() && u > positions_[k + 1]) ++k;
  const auto& breaks = breaks_[k];
  const auto n = static_cast<int>(breaks.size());
  const double angle = positive_angle(psi);
  const auto after = static_cast<int>(std::upper_bound(breaks.begin(), breaks.end(), angle) - breaks.begin());
  const int j = (after + n - 1) % n;
  const double width = after % n == 0 ? breaks.front() + 2 * kPi - breaks.back() : breaks[after] - breaks[j];
  const double length = positions_[k + 1] - positions_[k];
  return {cell_start_[k] + j,
          (u - positions_[k]) / length,
          positive_angle(angle - breaks[j]) / width,
          length,
          breaks[j],
          width};
}

}  // namespace cardiac
