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

// Angle (rad) by which one steps off a border to ask for the segment beside it: far above rounding and far
// below the width of a sector.
constexpr double kBeside = 1e-3;

int kind_at(const std::vector<int>& kind, int ring, double psi) {
  const double middle_height = (ring - 0.5) / 3;
  return kind[aha_segment(middle_height, psi) - 1];
}

// The kinds of a ring on the two sides of the angle of a border.
struct KindsBeside {
  int before = 0, behind = 0;
  bool operator==(const KindsBeside&) const = default;
  bool alike() const { return before == behind; }
};
KindsBeside kinds_beside(const std::vector<int>& kind, int ring, double border) {
  return {kind_at(kind, ring, border - kBeside), kind_at(kind, ring, border + kBeside)};
}

// Whether four segments meet in a corner of the border between different kinds,
//
//     high.before │ high.behind
//     ────────────┼────────────
//      low.before │ low.behind
//
// so that it does not pass straight through (up where the rings are the same, across where each ring has one
// kind) or stay away.
bool is_corner(const KindsBeside& low, const KindsBeside& high) {
  const bool straight_up = low == high, straight_across = low.alike() && high.alike();
  return !straight_up && !straight_across;
}

}  // namespace

BorderFrames::BorderFrames(std::shared_ptr<const SegmentFrames> frames, const std::vector<int>& kind)
    : frames_(std::move(frames)), positions_{0} {
  for (const FrameRing& ring : frames_->layout().rings) positions_.push_back(ring.u);
  positions_.push_back(1);
  add_in_rings(kind);
  add_between_rings(kind);
}

// Borders between two segments of one ring.
void BorderFrames::add_in_rings(const std::vector<int>& kind) {
  for (int ring = 1; ring <= kAhaRings; ++ring) {
    const double sector = 2 * kPi / aha_ring_size(ring);
    for (int j = 0; j < aha_ring_size(ring); ++j) {
      const double border = (j + 0.5) * sector;
      if (!kinds_beside(kind, ring, border).alike()) hats_.push_back({ring, ring, border, sector / 2});
    }
  }
}

// Borders between a ring and the next, and the corners on them; in steps of the finer of the two rings.
void BorderFrames::add_between_rings(const std::vector<int>& kind) {
  for (int low = 0; low < kAhaRings; ++low) {
    const int high = low + 1;
    const int sectors = std::max(aha_ring_size(low), aha_ring_size(high));
    const double sector = 2 * kPi / sectors;
    for (int j = 0; j < sectors; ++j) {
      const double middle = j * sector, border = middle + sector / 2;
      if (kind_at(kind, low, middle) != kind_at(kind, high, middle))
        hats_.push_back({low, high, middle, sector});
      if (is_corner(kinds_beside(kind, low, border), kinds_beside(kind, high, border)))
        hats_.push_back({low, high, border, sector / 2});
    }
  }
}

// A hat along the wall: the tent of its ring, or over the border of two rings a/(a + b),
//
//                 1 at the border                 a   distance to the nearer ring's nodes
//        0  ────╱╲────  0                         b   distance to the border
//     low ring      high ring                     both in u, on the side of the border where the point lies
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
  const double border_height = hat.low / 3.0;  // rings are thirds of the long axis
  const double height =
      coordinates.cavity_length() * (coordinates.long_axis_height(X) - border_height);  // mm
  const bool above = height > 0;
  const double side = above ? -1 : 1;  // sign of ∂a/∂u
  const double a = above ? high - at.u : at.u - low, b = -side * u_per_mm * height;
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
  const double depth = frames_->layout().rings.front().thickness / frames_->layout().length;
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
    frame.xi[2] = depth * (at.t - 0.5);
    frame.xi_gradient.row(2) = depth * at.grad_t.transpose();
    out.frames.push_back(frame);
  }
  return out;
}

}  // namespace cardiac
