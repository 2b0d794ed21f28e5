#pragma once

#include <functional>
#include <string>
#include <vector>

#include <cardiac/report/colour_map.hpp>
#include <cardiac/report/svg.hpp>
#include <cardiac/report/wall_cut.hpp>

namespace cardiac {

/// A parallel projection: `towards_viewer` points out of the picture, `up` (not parallel to it) upwards.
struct WallView {
  polyaffine::Vec3 towards_viewer, up;
  std::string left, right;  ///< what lies on either side
  /// Right, up and towards the viewer as rows.
  polyaffine::Mat3 camera() const;
};

/// A wall to be drawn: the corners of its cut (3 × corners, mm), the segment from 1 of each tet of the mesh
/// that was cut, and the colour of each segment.
struct WallScene {
  const WallCut& cut;
  const std::vector<int>& segment;
  polyaffine::Mat3 camera;
  polyaffine::Points positions;
  std::function<Rgb(int segment)> colour;
};

/// Where a place of the drawing lies: the seen point `centre` at `origin`, a mm `scale` units long.
struct WallPlacement {
  polyaffine::Vec3 centre;
  double scale = 1;
  DrawPoint origin;
  DrawPoint operator()(const polyaffine::Vec3& seen) const;
};

/// Draws the faces, shaded by how they are turned, with borders of segments and of the section darker. Faces
/// turned away are left out, the others painted from the farthest to the nearest.
void draw_wall(Svg& svg, const WallScene& scene, const WallPlacement& place);

}  // namespace cardiac
