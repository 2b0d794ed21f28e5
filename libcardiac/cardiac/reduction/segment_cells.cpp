#include "cardiac/reduction/segment_cells.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <cardiac/anatomy/segments.hpp>

namespace cardiac {

using polyaffine::CellPlace;
using polyaffine::kPi;
using polyaffine::Vec3;
using polyaffine::Vec4;

namespace {

// Heights (0 apex of the cavity, 1 base) at which the rings of segments begin: the cap, three thirds of the
// long axis; and where the last one ends.
constexpr std::array<double, 5> kRingHeights{-HUGE_VAL, 0, 1.0 / 3, 2.0 / 3, HUGE_VAL};

// A point in a cell of the frames, and the AHA segment there.
struct PointInCell {
  SegmentFrames::Cell cell;
  double height = 0;  // along the long axis
  int segment = 0, ring = 0;
};

// How far along the wall, from 0 to 1, a point lies in the part of its cell that belongs to its ring of
// segments. A border of rings is a level of the height, one of the cell is a level of u, so both distances
// are taken in the unit of u and divide the way between them:
//
//     ───────────  upper border of the ring if the cell holds the next ring too, else top of the cell
//          │ above
//          ●       below / (below + above)
//          │ below
//     ───────────  lower border of the ring if the cell holds the ring below too, else bottom of the cell
double share_along(const PointInCell& at, const std::array<bool, 4>& rings_in_cell, double u_per_height) {
  const bool ends_below = at.ring > 0 && rings_in_cell[at.ring - 1];
  const bool ends_above = at.ring < kAhaRings && rings_in_cell[at.ring + 1];
  const double below =
      ends_below ? u_per_height * (at.height - kRingHeights[at.ring]) : at.cell.u * at.cell.length;
  const double above =
      ends_above ? u_per_height * (kRingHeights[at.ring + 1] - at.height) : (1 - at.cell.u) * at.cell.length;
  return below / (below + above);
}

// How far around the wall, from 0 to 1, a point lies in the part of its cell that belongs to its segment:
// where the sector of the segment and that of the cell overlap. Angles count from the beginning of the cell:
//
//     0 ├──────── cell ────────┤ width
//              ├────── segment ──────┤      middle ± half
//          low ├───●───────────┤ high
//
// The angle of two ventricles is not quite that of the sectors: where these do not overlap, the cell alone
// tells it.
double share_around(const PointInCell& at) {
  const double width = at.cell.width;
  double low = 0, high = width;
  if (at.ring > 0) {  // the cap goes all the way round
    const double half = kPi / aha_ring_size(at.ring);
    const double middle =
        width / 2 + std::remainder(aha_centre_angle(at.segment) - (at.cell.angle + width / 2), 2 * kPi);
    low = std::max(low, middle - half);
    high = std::min(high, middle + half);
  }
  constexpr double kOverlap = 1e-6;  // of the cell; a thinner part is rounding
  if (!(high - low > kOverlap * width)) return at.cell.psi;
  return (at.cell.psi * width - low) / (high - low);
}

}  // namespace

SegmentCells::SegmentCells(std::shared_ptr<const SegmentFrames> frames, const std::vector<int>& kind)
    : frames_(std::move(frames)), division_of_(frames_->num_cells(), -1) {
  const VentricularCoordinates& coordinates = frames_->coordinates();
  const Vec4 centre = Vec4::Constant(0.25);
  std::vector<std::set<int>> segments(frames_->num_cells());
  for (int t = 0; t < static_cast<int>(coordinates.space().elements().cols()); ++t) {
    const int segment = segment_at(coordinates, t, centre, coordinates.position(t, centre));
    const int cell = frames_->point_cell(t, centre).index;
    if (cell < frames_->num_cells() && segment <= kAhaSegments) segments[cell].insert(segment);
  }
  for (int cell = 0; cell < frames_->num_cells(); ++cell) {
    std::set<int> kinds;
    Division division{cell, {}};
    for (const int s : segments[cell]) {
      kinds.insert(kind[s - 1]);
      division.rings[aha_ring(s)] = true;
    }
    if (kinds.size() < 2) continue;
    division_of_[cell] = static_cast<int>(divisions_.size());
    divisions_.push_back(division);
  }
}

// Cells are numbered in this order: the parts of divided cells, then the cells of the frames.
CellPlace SegmentCells::operator()(int tet, const Vec4& barycentric) const {
  const auto whole = frames_->point_cell(tet, barycentric);
  const int division = whole.index < frames_->num_cells() ? division_of_[whole.index] : -1;
  if (division >= 0) return part(divisions_[division], tet, barycentric);
  return {kAhaSegments * static_cast<int>(divisions_.size()) + whole.index, whole.place};
}

CellPlace SegmentCells::part(const Division& division, int tet, const Vec4& barycentric) const {
  const VentricularCoordinates& coordinates = frames_->coordinates();
  const CoordinateSample sample = coordinates.sample(tet, barycentric);
  const Vec3 X = coordinates.position(tet, barycentric);
  PointInCell at{frames_->cell(sample.u, sample.psi), coordinates.long_axis_height(X)};
  at.segment = aha_segment(at.height, coordinates.sector_angle(X));
  at.ring = aha_ring(at.segment);
  const double u_per_height = coordinates.cavity_length() / coordinates.arc_length();
  const Vec3 place(share_along(at, division.rings, u_per_height), share_around(at), sample.t);
  return {kAhaSegments * division_of_[division.cell] + at.segment - 1, place};
}

bool SegmentCells::at_apex(int cell) const {
  const int parts = kAhaSegments * static_cast<int>(divisions_.size());
  const int whole = cell < parts ? divisions_[cell / kAhaSegments].cell : cell - parts;
  return frames_->at_apex(whole);
}

}  // namespace cardiac
