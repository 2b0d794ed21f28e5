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

// Numbers of cells: the parts first, then those of the frames.
CellPlace SegmentCells::operator()(int tet, const Vec4& barycentric) const {
  const auto whole = frames_->point_cell(tet, barycentric);
  const int division = whole.index < frames_->num_cells() ? division_of_[whole.index] : -1;
  if (division >= 0) return part(divisions_[division], tet, barycentric);
  return {kAhaSegments * static_cast<int>(divisions_.size()) + whole.index, whole.place};
}

CellPlace SegmentCells::part(const Division& division, int tet, const Vec4& barycentric) const {
  constexpr std::array<double, 5> kHeights{-HUGE_VAL, 0, 1.0 / 3, 2.0 / 3, HUGE_VAL};
  const VentricularCoordinates& coordinates = frames_->coordinates();
  const CoordinateSample at = coordinates.sample(tet, barycentric);
  const Vec3 X = coordinates.position(tet, barycentric);
  const double height = coordinates.long_axis_height(X);
  const int segment = aha_segment(height, coordinates.sector_angle(X)), ring = aha_ring(segment);
  const SegmentFrames::Cell cell = frames_->cell(at.u, at.psi);

  // Distances to the lower and the upper border, both in the unit of u.
  const double u_per_height = coordinates.cavity_length() / coordinates.arc_length();
  const bool ends_below = ring > 0 && division.rings[ring - 1];
  const bool ends_above = ring < 3 && division.rings[ring + 1];
  const double below = ends_below ? u_per_height * (height - kHeights[ring]) : cell.u * cell.length;
  const double above = ends_above ? u_per_height * (kHeights[ring + 1] - height) : (1 - cell.u) * cell.length;

  double low = 0, high = cell.width;  // rad, from the beginning of the cell
  if (ring > 0) {
    const double half = kPi / aha_ring_size(ring), middle = cell.angle + cell.width / 2;
    const double from_middle = std::remainder(aha_centre_angle(segment) - middle, 2 * kPi);
    low = std::max(low, cell.width / 2 + from_middle - half);
    high = std::min(high, cell.width / 2 + from_middle + half);
  }
  const int number = kAhaSegments * division_of_[division.cell] + segment - 1;
  return {number, Vec3(below / (below + above), (cell.psi * cell.width - low) / (high - low), at.t)};
}

bool SegmentCells::at_apex(int cell) const {
  const int parts = kAhaSegments * static_cast<int>(divisions_.size());
  const int whole = cell < parts ? divisions_[cell / kAhaSegments].cell : cell - parts;
  return whole < frames_->num_apex_cells();
}

}  // namespace cardiac
