#pragma once

#include <vector>

#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// Areas of triangles, mm².
Vector triangle_areas(const Points& points, const Triangles& triangles);

/// Area of the boundary that carries one of the labels, mm².
double surface_area(const TetMesh& mesh, const std::vector<int>& labels);

/// Edges of triangles that belong to one triangle only, chained to closed loops of vertex indices in the
/// triangles' direction of travel; empty for a closed surface. Loops begin at their smallest index and are
/// sorted by it.
/// Throws InputError "open cavity" when there are no triangles, an edge belongs to more than two, two
/// neighbours disagree in orientation, or a rim touches itself.
std::vector<std::vector<int>> rim_loops(const Triangles& triangles);

/// A surface closed by a fan from each rim loop to the loop's centroid, which encloses a volume.
///
/// V = −1/6 Σ det[x_a, x_b, x_c] over triangles and fans: positive for a cavity in a wall, whose boundary
/// triangles point out of the wall and thus into the cavity. It does not depend on the origin.
class EnclosedVolume {
 public:
  /// Throws as rim_loops.
  explicit EnclosedVolume(Triangles triangles);
  /// The boundary of the mesh with one of the labels; the message of the error names them.
  EnclosedVolume(const TetMesh& mesh, const std::vector<int>& labels);

  const Triangles& triangles() const { return triangles_; }
  const std::vector<std::vector<int>>& rims() const { return rims_; }

  /// mm³; points are 3 × n in any deformed state (mm).
  double value(const Points& points) const;
  /// ∂V/∂x, 3 × n (mm²), zero for points off the surface. At a closed surface −Σ of it over the surface is 0.
  Points gradient(const Points& points) const;

 private:
  Triangles triangles_;
  std::vector<std::vector<int>> rims_;
};

}  // namespace polyaffine
