#pragma once

#include <limits>

#include <polyaffine/core/types.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>

namespace polyaffine {

struct RegionWeightOptions {
  double sharpness = 2.25;  ///< a of σ_a; at a region's node σ_a(−1) = .905
  /// Normalised distance from which a weight is zero; ∞: every region reaches everywhere.
  double support = std::numeric_limits<double>::infinity();
};

/// Weights of all regions at a point: φ (n) and ∇φ (3 × n, 1/mm).
struct RegionWeightValues {
  Vector values;
  Points gradients;
};

/// Partition of unity by sigmoids of the normalised signed distance d_i to the border of each region,
///   φ_i = w_i / Σ_j w_j,  w_i = σ_a(d_i) h(d_i),  σ_a(d) = 1 / (1 + e^{ad}),
///   h(d) = 1 for d ≤ 0, (1 − (d/s)²)² to the support s, 0 beyond,
/// with d_i interpolated linearly from the vertices. σ alone sums to one only between two mirror images, so
/// the normalised form is what is differentiated.
class RegionWeights {
 public:
  /// Distances: regions × vertices, as from normalised_border_distances; every point must lie at d ≤ 0 or
  /// within the support of some region. Keeps a reference to the mesh. Throws InputError when the sizes
  /// differ, a distance is not finite, or sharpness or support is not positive.
  RegionWeights(const TetMesh& mesh, Matrix distances, const RegionWeightOptions& options = {});
  RegionWeights(TetMesh&&, Matrix, const RegionWeightOptions& = {}) = delete;

  int num_regions() const { return static_cast<int>(distances_.rows()); }
  /// Throws ComputationError when no region reaches the point.
  RegionWeightValues evaluate(int tet, const Vec4& barycentric) const;

 private:
  const TetMesh& mesh_;
  Matrix distances_;
  RegionWeightOptions options_;
};

}  // namespace polyaffine
