#pragma once

#include <vector>

#include <cardiac/reduction/nested_space.hpp>
#include <cardiac/training/full_order.hpp>

namespace cardiac {

/// What each node of the elements has of the wall's volume, mm³.
polyaffine::Vector node_volumes(const polyaffine::LagrangeBasis& elements);
/// ‖u‖ over the wall by values at the nodes (3 · nodes), with the volumes of these; mm · mm^1.5.
double displacement_size(const polyaffine::Vector& node_volumes, const polyaffine::Vector& u);

/// Spaces that hold displacements and pressures of full-order states of a heart, grown by modes: what a space
/// leaves of some states, by singular vectors (Sirovich 1987). Displacements are measured in the H1 seminorm
/// ‖∇u‖ over the wall, pressures in L2.
class HeartModes {
 public:
  using States = std::vector<const FullState*>;

  HeartModes(const Anatomy& anatomy, const Scene& scene);

  /// The affine space of the scene, without modes.
  const NestedSpace& affine() const { return affine_; }
  /// A space with so many modes more, `most` in all, that it holds the displacement of each state to
  /// `tolerance` of its norm.
  NestedSpace with_modes(NestedSpace space, const States& states, double tolerance, int most) const;
  /// A space with so many pressures more that it holds those of each state to `tolerance` of their norm.
  NestedSpace with_pressures(NestedSpace space, const States& states, double tolerance, int most) const;

  /// Metric of the functions of a space: cᵀ G c = ‖∇u‖², mm³; fixed unknowns have a one on the diagonal.
  polyaffine::Matrix metric(const NestedSpace& space) const;
  /// Coefficients of the function of a space nearest to a nodal displacement.
  polyaffine::Vector nearest(const NestedSpace& space, const polyaffine::Matrix& metric,
                             const polyaffine::Vector& u) const;
  /// The nodal displacement of coefficients.
  polyaffine::Vector nodal(const NestedSpace& space, const polyaffine::Vector& c) const;
  /// Coefficients of the pressures of a space nearest to those of the elements, kPa.
  polyaffine::Vector nearest_pressure(const NestedSpace& space, const polyaffine::Vector& pressure) const;
  /// displacement_size.
  double size(const polyaffine::Vector& u) const { return displacement_size(node_volumes_, u); }

 private:
  polyaffine::Matrix gradient(const polyaffine::Vector& u) const;  // 3 · points × 3, weighted

  NestedSpace affine_;
  polyaffine::NodalFunctions nabla_;  // ∇ at integration points times √weight: 3 · points × nodes
  polyaffine::Matrix frame_gradients_;
  polyaffine::Matrix frame_metric_;
  polyaffine::Vector tet_volumes_, node_volumes_;
};

}  // namespace cardiac
