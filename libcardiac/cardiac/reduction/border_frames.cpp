#include "cardiac/reduction/border_frames.hpp"

#include <algorithm>
#include <cmath>

#include <cardiac/anatomy/right_ventricle.hpp>
#include <cardiac/anatomy/segments.hpp>

namespace cardiac {

using polyaffine::kPi;
using polyaffine::Vec3;
using polyaffine::Vec4;

namespace {

constexpr double kBeside = 1e-3;  // rad

int kind_at(const std::vector<int>& kind, int ring, double psi) {
  const double middle_height = (ring - 0.5) / 3;
  return kind[aha_segment(middle_height, psi) - 1];
}

}  // namespace

BorderFrames::BorderFrames(std::shared_ptr<const SegmentFrames> frames, const std::vector<int>& kind)
    : frames_(std::move(frames)), positions_{0} {
  for (const FrameRing& ring : frames_->layout().rings) positions_.push_back(ring.u);
  positions_.push_back(1);
  add_in_rings(kind);
  add_between_rings(kind);
}

void BorderFrames::add_in_rings(const std::vector<int>& kind) {
  for (int ring = 1; ring <= 3; ++ring) {
    const double sector = 2 * kPi / aha_ring_size(ring);
    for (int j = 0; j < aha_ring_size(ring); ++j) {
      const double border = (j + 0.5) * sector;
      if (kind_at(kind, ring, border - kBeside) != kind_at(kind, ring, border + kBeside))
        hats_.push_back({ring, ring, border, sector / 2});
    }
  }
}

void BorderFrames::add_between_rings(const std::vector<int>& kind) {
  for (int low = 0; low <= 2; ++low) {
    const int high = low + 1, n = std::max(aha_ring_size(low), aha_ring_size(high));
    const double sector = 2 * kPi / n;
    for (int j = 0; j < n; ++j) {
      const double middle = j * sector, border = middle + sector / 2;
      if (kind_at(kind, low, middle) != kind_at(kind, high, middle))
        hats_.push_back({low, high, middle, sector});
      const auto below =
          std::pair(kind_at(kind, low, border - kBeside), kind_at(kind, low, border + kBeside));
      const auto above =
          std::pair(kind_at(kind, high, border - kBeside), kind_at(kind, high, border + kBeside));
      const bool straight = below == above || (below.first == below.second && above.first == above.second);
      if (!straight) hats_.push_back({low, high, border, sector / 2});
    }
  }
}

BorderFrames::Value BorderFrames::along(const Hat& hat, const CoordinateSample& at, const Vec3& X) const {
  if (hat.low == hat.high) {
    const double top = positions_[hat.low];
    const double foot = positions_[at.u > top ? hat.low + 1 : hat.low - 1];
    const double share = (at.u - foot) / (top - foot);
    if (share <= 0) return {};
    return {share, at.grad_u / (top - foot)};
  }
  const double low = positions_[hat.low], high = positions_[hat.high];
  if (at.u <= low || at.u >= high) return {};
  const VentricularCoordinates& coordinates = frames_->coordinates();
  const double u_per_mm = 1 / coordinates.arc_length();
  const double height =
      coordinates.cavity_length() * (coordinates.long_axis_height(X) - hat.low / 3.0);  // over the border, mm
  const double side = height > 0 ? -1 : 1;
  const double a = height > 0 ? high - at.u : at.u - low, b = -side * u_per_mm * height;
  const Vec3 grad_a = side * at.grad_u, grad_b = -side * u_per_mm * coordinates.axis();
  return {a / (a + b), (b * grad_a - a * grad_b) / ((a + b) * (a + b))};
}

polyaffine::FramesAtPoint BorderFrames::sample(int tet, const Vec4& barycentric) const {
  polyaffine::FramesAtPoint out = frames_->sample(tet, barycentric);
  const VentricularCoordinates& coordinates = frames_->coordinates();
  Value left{1, Vec3::Zero()};
  if (coordinates.right()) {
    const auto border = coordinates.right()->border(tet, barycentric);
    left = {1 - border.share, -border.share_gradient};
  }
  if (left.value == 0) return out;
  const CoordinateSample at = coordinates.sample(tet, barycentric);
  const Vec3 X = coordinates.position(tet, barycentric);
  for (std::size_t i = 0; i < hats_.size(); ++i) {
    const double from_top = std::remainder(at.psi - hats_[i].angle, 2 * kPi);
    const double around = 1 - std::abs(from_top) / hats_[i].half_width;
    if (around <= 0) continue;
    const Vec3 around_gradient = (from_top > 0 ? -1 : 1) / hats_[i].half_width * at.grad_psi;
    const Value u = along(hats_[i], at, X);
    if (u.value == 0) continue;
    polyaffine::FrameSample frame;
    frame.frame = frames_->num_frames() + static_cast<int>(i);
    frame.weight = left.value * u.value * around;
    frame.weight_gradient = u.value * around * left.gradient + left.value * around * u.gradient +
                            left.value * u.value * around_gradient;
    out.frames.push_back(frame);
  }
  return out;
}

}  // namespace cardiac
