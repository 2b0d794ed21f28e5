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

// Angles closer than this are the same break, rad: far above rounding, far below the angle between two nodes.
constexpr double kSameAngle = 1e-9;

// The angle in [0, 2π).
double positive_angle(double psi) {
  const double angle = std::fmod(psi, 2 * kPi);
  return angle < 0 ? angle + 2 * kPi : angle;
}

// Sorted, without repetitions; across 2π too.
void make_unique(std::vector<double>& angles) {
  std::sort(angles.begin(), angles.end());
  const auto same = [](double a, double b) { return b - a < kSameAngle; };
  angles.erase(std::unique(angles.begin(), angles.end(), same), angles.end());
  if (same(angles.back(), angles.front() + 2 * kPi)) angles.pop_back();
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
    make_unique(breaks);
    cell_start_.push_back(cell_start_.back() + static_cast<int>(breaks.size()));
    breaks_.push_back(std::move(breaks));
  }
}

// The frame of the cap, with its Cartesian coordinates.
FrameSample SegmentFrames::cap_sample(const Hat& along, const CoordinateSample& at, const Vec3& X) const {
  FrameSample f{layout_.cap(), along.value, along.slope * at.grad_u, {}, {}};
  f.xi = cap_axes_.transpose() * (X - cap_node_) / layout_.length;
  f.xi_gradient = cap_axes_.transpose() / layout_.length;
  return f;
}

// The two frames of ring k (counted from 0; that of the base frames is the last) between whose nodes the
// point lies, with the weights R_k(u) C_j(ψ).
void SegmentFrames::add_ring(std::size_t k, const Hat& along, const CoordinateSample& at,
                             std::vector<FrameSample>& frames) const {
  const bool base = k == layout_.rings.size();
  const FrameRing& ring = base ? layout_.rings.back() : layout_.rings[k];
  const int first_frame = base ? layout_.num_nodes() : ring.first_frame;
  const double step = ring.step();
  const double place = (at.psi - ring.angle) / step;  // counted in nodes
  const int below = static_cast<int>(std::floor(place));
  const Vec3 scale = Vec3(coordinates_->arc_length(), ring.radius, ring.thickness) / layout_.length;
  for (int side = 0; side < 2; ++side) {
    const int j = below + side;
    const Hat around{1 - std::abs(place - j), (side == 0 ? -1 : 1) / step};
    FrameSample f;
    f.frame = first_frame + (j % ring.nodes + ring.nodes) % ring.nodes;
    f.weight = along.value * around.value;
    f.weight_gradient = along.slope * around.value * at.grad_u + along.value * around.slope * at.grad_psi;
    f.xi = scale.cwiseProduct(
        Vec3(at.u - positions_[k + 1], std::remainder(at.psi - ring.angle - j * step, 2 * kPi), at.t - 0.5));
    f.xi_gradient << scale[0] * at.grad_u.transpose(), scale[1] * at.grad_psi.transpose(),
        scale[2] * at.grad_t.transpose();
    frames.push_back(f);
  }
}

// Along the wall the weights are tents over the positions of the cap (0), the rings and, with base frames,
// the base (1). Without base frames that of the basal ring stays 1 up to the base:
//
//       cap    ring 1   ring 2       base
//     1 ╲      ╱╲      ╱──────────
//         ╲  ╱    ╲  ╱
//     0     ╳       ╳
//       0      u_1      u_2          1     u
FramesAtPoint SegmentFrames::sample(int tet, const Vec4& barycentric) const {
  const CoordinateSample at = coordinates_->sample(tet, barycentric);
  const Vec3 X = coordinates_->position(tet, barycentric);
  const std::size_t last = base_frames_ ? positions_.size() - 1 : positions_.size() - 2;
  std::size_t k = 0;
  while (k + 1 < last && at.u > positions_[k + 1]) ++k;
  const double width = positions_[k + 1] - positions_[k];
  // Quadratic interpolation may pass 0 and 1 by a little: weights are constant there.
  const bool beyond = at.u <= 0 || at.u >= positions_[last];
  const double slope = beyond ? 0.0 : 1 / width;
  const double share = std::clamp((at.u - positions_[k]) / width, 0.0, 1.0);
  const Hat lower{1 - share, -slope}, upper{share, slope};

  FramesAtPoint out;
  out.Q = at.Q;
  out.dQ = at.dQ;
  if (lower.value > 0 && k == 0) out.frames.push_back(cap_sample(lower, at, X));
  if (lower.value > 0 && k > 0) add_ring(k - 1, lower, at, out.frames);
  if (upper.value > 0) add_ring(k, upper, at, out.frames);
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
  // The breaks before and behind the angle; before the first one comes the last of the former turn.
  const auto behind =
      static_cast<int>(std::upper_bound(breaks.begin(), breaks.end(), angle) - breaks.begin());
  const int before = (behind + n - 1) % n;
  Cell out;
  out.index = cell_start_[k] + before;
  out.length = positions_[k + 1] - positions_[k];
  out.u = (u - positions_[k]) / out.length;
  out.angle = breaks[before];
  out.width = behind % n == 0 ? breaks.front() + 2 * kPi - breaks.back() : breaks[behind] - breaks[before];
  out.psi = positive_angle(angle - breaks[before]) / out.width;
  return out;
}

}  // namespace cardiac
