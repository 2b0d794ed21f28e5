#pragma once

#include <cardiac/reduction/discretisation.hpp>
#include <polyaffine/kinematics/nested_basis.hpp>

namespace cardiac {

/// The reduced space of one heart that is nested in its full-order model, so that the reduced model is a
/// Galerkin projection of that: modes of the heart and, if the scene keeps them, the affine maps of the
/// control frames, both by their values at the nodes of the quadratic elements, and pressures that are
/// constant in each element.
struct NestedSpace {
  std::shared_ptr<const polyaffine::FrameBasis> frame_basis;  ///< Cartesian axes, functions 1, l, c, t
  polyaffine::NodalFunctions frames;                          ///< its functions, zero on the base
  polyaffine::Matrix modes;      ///< 3 · nodes × modes, their number a multiple of three
  int num_modes = 0;             ///< without the columns of zeros that fill it up
  polyaffine::Matrix pressures;  ///< functions × elements: of the segments or the wall, then modes
};

/// The space without modes. With affine frames their functions at the nodes of the scene's layout (tents;
/// those that depend on others are left out) and one pressure a segment, else no function and one pressure.
NestedSpace affine_space(const Anatomy& anatomy, const Scene& scene);

/// The model of a space with all integration points of the full-order one, whose `full` is given.
Discretisation nested_discretisation(const Anatomy& anatomy, const Scene& scene, const NestedSpace& space,
                                     const Discretisation& full);

/// The pressure space of a nested model, its mass that of the elements.
polyaffine::PressureSpace element_pressure_space(const Discretisation& discretisation,
                                                 const polyaffine::FieldTable& table,
                                                 double bulk_modulus_kPa);

/// Some of many points, with new weights, block after block.
struct KeptPoints {
  std::vector<int> points;
  polyaffine::Vector weights;  ///< mm³, of a surface in the unit of its weights
  std::vector<int> starts;     ///< of the blocks, and the number of points
};

/// Some of many points in blocks that see nearly the same functions.
KeptPoints in_blocks(const polyaffine::Basis& basis, const std::vector<int>& tet,
                     const Eigen::Matrix4Xd& barycentric, const std::vector<int>& points,
                     const polyaffine::Vector& weights);
polyaffine::WallPoints kept(const polyaffine::WallPoints& all, const KeptPoints& which);
polyaffine::SurfacePoints kept(const polyaffine::SurfacePoints& all, const KeptPoints& which);

}  // namespace cardiac
