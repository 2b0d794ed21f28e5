#pragma once

#include <array>
#include <memory>
#include <vector>

#include <cardiac/reduction/segment_frames.hpp>
#include <polyaffine/quadrature/cell_place.hpp>

namespace cardiac {

/// Cells in which the weights of frames and the properties of the wall are smooth: those of the frames
/// (SegmentFrames::point_cell) and, of one in which segments meet that differ, its parts in each segment.
class SegmentCells {
 public:
  /// Segments of the same number kind[s − 1] have the same properties.
  SegmentCells(std::shared_ptr<const SegmentFrames> frames, const std::vector<int>& kind);

  /// Cell and place of a point of the mesh. In a part of a cell places run from border to border, those of
  /// the segments included, which are levels of the height and of the rotational coordinate.
  polyaffine::CellPlace operator()(int tet, const polyaffine::Vec4& barycentric) const;

  /// Whether a cell reaches the long axis.
  bool at_apex(int cell) const;

 private:
  struct Division {
    int cell = 0;
    std::array<bool, 4> rings{};  // which rings of segments (aha_ring) have a part in it
  };
  polyaffine::CellPlace part(const Division& division, int tet, const polyaffine::Vec4& barycentric) const;

  std::shared_ptr<const SegmentFrames> frames_;
  std::vector<Division> divisions_;
  std::vector<int> division_of_;  // of each cell of the frames, −1 where it is whole
};

}  // namespace cardiac
