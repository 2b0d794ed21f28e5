#pragma once

#include <polyaffine/mesh/tet_mesh.hpp>
#include <polyaffine/mesh_io/label_fields.hpp>

namespace polyaffine {

/// A mesh and the fields of its file: each field components × points, or components × tets. The cell arrays
/// "surface" and "region" are part of the mesh, not fields.
struct MeshFile {
  TetMesh mesh;
  std::map<std::string, Matrix> point_fields{}, cell_fields{};
  std::vector<std::string> notes{};  ///< what was repaired, left out or reduced
};

/// A valid mesh in mm out of what a file holds; mm_per_unit is 1 for mm, 10 for cm, 1000 for m.
///
/// Repaired and noted: points in the same place (within 1e-7 of the size of the mesh) are joined, points
/// without a tet dropped, tets of negative orientation turned, provided that neighbours then lie on opposite
/// sides of their common face; labelled triangles between two tets are left out, and so are repetitions and
/// those of optional labels that are no faces. A triangle listed with two labels has that which is not
/// optional, or the first of them. Labelled triangles on points
/// of their own are joined to the tets by position (within 1e-5 of the size). The tet field "region" gives
/// the region of each tet. All fields keep their values and units.
/// Throws InputError, naming file and place, for a coordinate that is not finite, a flat or inverted tet, a
/// face of more than two tets, a boundary that is not manifold, parts that share no face, a labelled triangle
/// that is no face, or a field value that is not finite.
MeshFile assemble(const MeshData& volume, const SurfaceData& surface, double mm_per_unit);

/// Makes points in the same place one (within 1e-7 of the size of the mesh) and notes how many went.
void join_points(MeshData& data);

}  // namespace polyaffine
