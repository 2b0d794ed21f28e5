#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/geometry/locate.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

/// A place where the front starts, and when.
struct EikonalSource {
  MeshPoint at;
  double time = 0;
};

/// First arrival of fronts: times at the vertices and the source (a label) each came from.
struct Arrival {
  Vector time;             ///< +∞ where no front comes
  std::vector<int> label;  ///< −1 where no front comes
};

/// Solves ∇Tᵀ D ∇T = 1 on a tetrahedral mesh: T is the time of first arrival of fronts that travel inside the
/// mesh with the speed tensor D (constant on a tet, symmetric positive definite, (mm/ms)²); with D = I it is
/// the geodesic distance in mm.
///
/// A vertex takes the least Σ λ_i T_i + |x − Σ λ_i x_i|_{D⁻¹} over the faces opposite to it (Hopf–Lax update,
/// with edges and corners as fallback). Vertices are visited in the order of their times, and again whenever
/// a neighbour became earlier after all, which obtuse tets and anisotropy make possible; the result is thus
/// the one fixed point of the update, whatever the numbering (Bornemann and Rasch 2006; Kimmel and Sethian
/// 1998; first order in the mesh size).
class EikonalSolver {
 public:
  /// D per tet, or none for D = I. Keeps a reference to the mesh. Throws InputError when the number of
  /// tensors is wrong or one is not symmetric positive definite.
  explicit EikonalSolver(const TetMesh& mesh, const std::vector<Mat3>& speed = {});
  EikonalSolver(TetMesh&&, const std::vector<Mat3>& = {}) = delete;

  const TetMesh& mesh() const { return mesh_; }

  /// Times for fronts from sources; label = index of the source. Vertices that a source sees in a straight
  /// line start with the time on that line, which is exact for constant D and removes the error that a linear
  /// update makes next to a point. Only tets with allowed[t] (all when empty) are crossed.
  Arrival march(const std::vector<EikonalSource>& sources, const std::vector<char>& allowed = {}) const;

  /// Times when the vertices start with the given values (one each, +∞ where free) and labels (−1 where
  /// free).
  Arrival march_from(Arrival initial, const std::vector<char>& allowed = {}) const;

  /// sqrt(vᵀ D⁻¹ v), the time to travel along v inside tet t.
  double travel_time(int t, const Vec3& v) const;

  const std::vector<int>& tets_around(int vertex) const { return around_[vertex]; }

 private:
  Eigen::Matrix<double, 3, 4> metric_corners(int t) const;
  bool improve(int t, int k, const Eigen::Matrix<double, 3, 4>& corners, Arrival& arrival) const;

  void start_straight(const MeshPoint& from, double time, int label, const std::vector<char>& allowed,
                      Arrival& initial) const;

  const TetMesh& mesh_;
  std::vector<Mat3> metric_root_;  // U with D⁻¹ = UᵀU, empty for D = I
  std::vector<std::vector<int>> around_;
};

/// EikonalSolver(mesh, speed).march(sources).time
Vector arrival_times(const TetMesh& mesh, const std::vector<EikonalSource>& sources,
                     const std::vector<Mat3>& speed = {});

}  // namespace polyaffine
