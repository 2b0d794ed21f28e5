#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/geometry/locate.hpp>

namespace polyaffine {

/// A cell of a wall (or of its surface) and a place in it, coordinates from 0 to 1.
struct CellPlace {
  int cell = 0;
  Vec3 place = Vec3::Zero();
};

/// Where a point of the mesh lies: smooth within a cell.
using PlaceOf = std::function<CellPlace(int tet, const Vec4& barycentric)>;

/// The point of the mesh at a place, to 1e-8 of the cell, found by Newton's method in the elements of `near`
/// from their points, one after the other, until one holds it. Starts with a barycentric coordinate of zero
/// keep it (a face), and only the first two coordinates of the place count. When none holds it, the element
/// that it is least outside of, by up to a tenth of the barycentric range; else nothing.
std::optional<MeshPoint> find_place(const PlaceOf& place_of, const CellPlace& wanted,
                                    const std::vector<MeshPoint>& near);

}  // namespace polyaffine
