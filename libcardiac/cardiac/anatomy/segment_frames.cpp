#include "cardiac/anatomy/segment_frames.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include <polyaffine/core/error.hpp>

namespace cardiac {

using polyaffine::FrameSample;
using polyaffine::FramesAtPoint;
using polyaffine::kPi;
using polyaffine::Vec3;
using polyaffine::Vec4;

namespace {

// The base frames sit above the six basal segments.
int ring_size(int ring) {
  return aha_ring_size(std::min(ring, 3));
}
int ring_first_frame(int ring) {
  return ring == 4 ? kAhaSegments : aha_ring_first(ring) - 1;
}

}  // namespace

FrameLayout frame_layout(const polyaffine::TetMesh& mesh, const VentricularCoordinates& coordinates,
                         const std::vector<double>& rings) {
  FrameLayout layout;
  std::array<double, 4> volume{};
  std::array<double, 4> u{};
  for (int t = 0; t < mesh.num_tets(); ++t) {
    const Vec3 X = mesh.tet_centroid(t);
    const CoordinateSample s = coordinates.sample(t, Vec4::Constant(0.25));
    const int ring = aha_ring(aha_segment(coordinates.long_axis_height(X), s.psi));
    const double v = mesh.tet_volume(t);
    volume[ring] += v;
    u[ring] += v * s.u;
    layout.radius[ring] += v / s.grad_psi.norm();
    layout.thickness[ring] += v / s.grad_t.norm();
  }
  for (int ring = 0; ring < 4; ++ring) {
    if (volume[ring] <= 0)
      throw polyaffine::InputError("mesh: no tet lies in ring " + std::to_string(ring) +
                                   " (0 cap, 1 apical, 2 mid, 3 basal) of the AHA segments");
    layout.radius[ring] /= volume[ring];
    layout.thickness[ring] /= volume[ring];
    if (ring > 0) layout.rings[ring - 1] = u[ring] / volume[ring];
  }
  if (!rings.empty()) std::copy_n(rings.begin(), 3, layout.rings.begin());
  if (!(0 < layout.rings[0] && layout.rings[0] < layout.rings[1] && layout.rings[1] < layout.rings[2] &&
        layout.rings[2] < 1))
    throw polyaffine::InputError(
        "reduction.ring_positions: expected three ascending numbers between 0 and 1");
  layout.length = std::cbrt(mesh.volume() / kAhaSegments);
  return layout;
}

polyaffine::Mat3 cap_axes(const VentricularCoordinates& c) {
  polyaffine::Mat3 axes;
  axes << c.anterior(), c.axis().cross(c.anterior()), -c.axis();
  return axes;
}

Vec3 cap_node_position(const VentricularCoordinates& c, const FrameLayout& layout) {
  return c.base_centre() - (c.cavity_length() + layout.thickness[0] / 2) * c.axis();
}

SegmentFrames::SegmentFrames(std::shared_ptr<const VentricularCoordinates> coordinates, FrameLayout layout,
                             bool base_frames)
    : coordinates_(std::move(coordinates)),
      layout_(layout),
      base_frames_(base_frames),
      cap_axes_(cap_axes(*coordinates_)),
      cap_node_(cap_node_position(*coordinates_, layout_)) {
  for (int interval = 0; interval < 4; ++interval) {
    auto& breaks = breaks_[interval];
    for (const int ring : {interval, interval + 1}) {
      if (ring == 0 || ring == 4) continue;
      for (int j = 0; j < ring_size(ring); ++j) breaks.push_back(2 * kPi * j / ring_size(ring));
    }
    std::sort(breaks.begin(), breaks.end());
    breaks.erase(std::unique(breaks.begin(), breaks.end(), [](double a, double b) { return b - a < 1e-9; }),
                 breaks.end());
    cell_start_[interval + 1] = cell_start_[interval] + static_cast<int>(breaks.size());
  }
}

FramesAtPoint SegmentFrames::sample(int tet, const Vec4& barycentric) const {
  const CoordinateSample at = coordinates_->sample(tet, barycentric);
  const Vec3 X = coordinates_->position(tet, barycentric);
  FramesAtPoint out;
  out.Q = at.Q;
  out.dQ = at.dQ;

  const auto add_cap = [&](double weight, double slope) {
    FrameSample f{kAhaSegments - 1, weight, slope * at.grad_u, {}, {}};
    f.xi = cap_axes_.transpose() * (X - cap_node_) / layout_.length;
    f.xi_gradient = cap_axes_.transpose() / layout_.length;
    out.frames.push_back(f);
  };
  const auto add_ring = [&](int ring, double weight, double slope) {
    const int n = ring_size(ring);
    const int segment_ring = std::min(ring, 3);
    const double step = 2 * kPi / n;
    const double place = at.psi / step;
    const int below = static_cast<int>(std::floor(place));
    for (int side = 0; side < 2; ++side) {
      const int j = below + side;
      const double hat = 1 - std::abs(place - j);
      const double hat_slope = (side == 0 ? -1 : 1) / step;
      FrameSample f;
      f.frame = ring_first_frame(ring) + (j % n + n) % n;
      f.weight = weight * hat;
      f.weight_gradient = slope * hat * at.grad_u + weight * hat_slope * at.grad_psi;
      const double u0 = ring == 4 ? 1.0 : layout_.rings[ring - 1];
      const Vec3 scale =
          Vec3(coordinates_->arc_length(), layout_.radius[segment_ring], layout_.thickness[segment_ring]) /
          layout_.length;
      f.xi = scale.cwiseProduct(
          Vec3(at.u - u0, std::remainder(at.psi - j * step, 2 * polyaffine::kPi), at.t - 0.5));
      f.xi_gradient << scale[0] * at.grad_u.transpose(), scale[1] * at.grad_psi.transpose(),
          scale[2] * at.grad_t.transpose();
      out.frames.push_back(f);
    }
  };

  const auto& r = layout_.rings;
  const std::array<double, 5> positions{0.0, r[0], r[1], r[2], 1.0};
  const int last = base_frames_ ? 4 : 3;
  int k = 0;
  while (k < last - 1 && at.u > positions[k + 1]) ++k;
  const double width = positions[k + 1] - positions[k];
  // Without base frames the basal ring reaches up to the base; quadratic interpolation may pass 0 and 1 by a
  // little.
  const bool beyond = at.u <= 0 || at.u >= positions[last];
  const double upper = std::clamp((at.u - positions[k]) / width, 0.0, 1.0);
  const double slope = beyond ? 0.0 : 1 / width;
  if (upper < 1) {
    if (k == 0)
      add_cap(1 - upper, -slope);
    else
      add_ring(k, 1 - upper, -slope);
  }
  if (upper > 0) add_ring(k + 1, upper, slope);
  return out;
}

SegmentFrames::Cell SegmentFrames::cell(double u, double psi) const {
  const auto& r = layout_.rings;
  const std::array<double, 5> positions{0.0, r[0], r[1], r[2], 1.0};
  int k = 0;
  while (k < 3 && u > positions[k + 1]) ++k;
  const auto& breaks = breaks_[k];
  const double angle = psi < 0 ? psi + 2 * kPi : psi;
  const auto after = std::upper_bound(breaks.begin(), breaks.end(), angle);
  const double end = after == breaks.end() ? 2 * kPi : *after;
  const auto j = static_cast<int>(after - breaks.begin()) - 1;
  return {cell_start_[k] + j, (u - positions[k]) / (positions[k + 1] - positions[k]),
          (angle - breaks[j]) / (end - breaks[j])};
}

}  // namespace cardiac
