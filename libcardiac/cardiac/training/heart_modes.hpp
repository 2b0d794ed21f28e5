#pragma once

#include <vector>

#include <cardiac/reduction/nested_space.hpp>
#include <cardiac/training/full_order.hpp>

namespace cardiac {

/// Displacements and pressures of full-order states, told by the affine frames of a heart, the pressures of
/// its segments, and modes: what these cannot hold (singular vectors; Sirovich 1987). Displacements are
/// measured in the H1 seminorm ‖∇u‖ over the wall, pressures in L2.
class HeartModes {
 public:
  HeartModes(const Anatomy& anatomy, const Scene& scene);

  /// The space with modes of the states: first those of `path`, until each is held to `tolerance` of its
  /// norm, then those of what remains of `neighbours` to `neighbour_tolerance`, at most `most` in all; the
  /// pressures of all to `pressure_tolerance`.
  struct Options {
    double tolerance = 0.003, neighbour_tolerance = 0.02, pressure_tolerance = 0.02;
    int most = 60;
  };
  NestedSpace space(const std::vector<FullState>& path, const std::vector<FullState>& neighbours,
                    const Options& options) const;

  /// Metric of the functions of a space: cᵀ G c = ‖∇u‖², mm³; fixed unknowns have a one on the diagonal.
  polyaffine::Matrix metric(const NestedSpace& space) const;
  /// Coefficients of the function of a space nearest to a nodal displacement.
  polyaffine::Vector nearest(const NestedSpace& space, const polyaffine::Matrix& metric,
                             const polyaffine::Vector& u) const;
  /// Coefficients of the pressures of a space nearest to those of the elements, kPa.
  polyaffine::Vector nearest_pressure(const NestedSpace& space, const polyaffine::Vector& pressure) const;
  /// ‖u‖ over the wall by values at the nodes, a share of its volume each; mm · mm^1.5.
  double size(const polyaffine::Vector& u) const;

 private:
  polyaffine::Matrix gradient(const polyaffine::Vector& u) const;  // 3 · points × 3, weighted

  NestedSpace affine_;
  polyaffine::NodalFunctions nabla_;  // ∇ at integration points times √weight: 3 · points × nodes
  polyaffine::Matrix frame_gradients_;
  polyaffine::Matrix frame_metric_;
  polyaffine::Vector tet_volumes_, node_volumes_;
};

}  // namespace cardiac
