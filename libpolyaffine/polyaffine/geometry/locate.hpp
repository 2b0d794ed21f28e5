#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// A place in a mesh: a tet and barycentric coordinates (≥ 0, sum 1) in it.
struct MeshPoint {
  int tet = -1;
  Vec4 barycentric = Vec4::Constant(0.25);
  double distance = 0;  ///< from the point asked for, mm; 0 when it lies in the mesh
};

/// λ with Σλ = 1 and Σ λ_k x_k = x for tet t; negative entries when x lies outside.
Vec4 barycentric(const TetMesh& mesh, int t, const Vec3& x);

/// X = Σ λ_k x_k, mm.
Vec3 position(const TetMesh& mesh, int t, const Vec4& barycentric);

/// The tet that holds x (mm), or the closest point of the boundary when none does. Visits every tet.
/// Throws InputError when x is not finite or the mesh is empty.
MeshPoint locate(const TetMesh& mesh, const Vec3& x);

/// The same among some tets only: the one that holds x, or the point of them closest to x.
MeshPoint locate(const TetMesh& mesh, const Vec3& x, const std::vector<int>& tets);

}  // namespace polyaffine
