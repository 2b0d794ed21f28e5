#pragma once

#include <string>
#include <vector>

#include <polyaffine/core/types.hpp>
#include <polyaffine/mesh/tet_mesh.hpp>
#include <polyaffine/mesh_io/assemble.hpp>

namespace cardiac {

/// Where and when the tissue is excited from outside (pacing site, Purkinje junction).
struct ActivationSite {
  polyaffine::Vec3 position;  ///< mm
  double onset = 0;           ///< ms
};

/// Activation times that were measured or computed elsewhere: points (mm) and their times (ms).
struct ActivationMap {
  polyaffine::Points points;
  polyaffine::Vector times_ms;
};

/// The times that a point array of a mesh file holds; `ms` is its unit. Throws InputError, `source` first,
/// when there is none of the name (saying which there are), it has more than one component or a value that is
/// no time.
ActivationMap map_of_array(const polyaffine::MeshFile& file, const std::string& name, double ms,
                           const std::string& source);

/// The times of a map at every vertex, ms: that of the point where one lies on the vertex, otherwise the mean
/// of the four nearest weighted by the inverse square of their distance (Shepard 1968). Throws InputError,
/// saying how far, when a vertex has no point within `largest_gap` (mm).
polyaffine::Vector mapped_times(const polyaffine::TetMesh& mesh, const ActivationMap& map,
                                double largest_gap = 30);

/// Conduction velocities, mm/ms (= m/s). Human ventricle: about 0.6 along and 0.3 across (Durrer et al.
/// 1970).
struct ConductionVelocity {
  double along_fibre = 0.6;
  double across_fibre = 0.3;
};

/// D = v_l² f⊗f + v_t² (I − f⊗f) for every tet, (mm/ms)²; fibre: unit directions, 3 × tets.
/// Throws InputError when a velocity is not positive or a fibre is not a unit vector.
std::vector<polyaffine::Mat3> conduction_tensors(const polyaffine::Points& fibre,
                                                 const ConductionVelocity& velocity);

/// Time at which every vertex is first excited (ms), from ∇Tᵀ D ∇T = 1 (eikonal equation, Colli Franzone et
/// al. 1990) with T = onset at the sites. A site may lie up to `largest_gap` (mm) outside the mesh and is
/// then moved to the closest point. For a uniform activation no equation is needed: the times are a constant.
/// Throws InputError when there is no site, one is too far from the mesh, or the fibres do not fit the mesh.
polyaffine::Vector activation_times(const polyaffine::TetMesh& mesh, const polyaffine::Points& fibre,
                                    const ConductionVelocity& velocity,
                                    const std::vector<ActivationSite>& sites, double largest_gap = 5);

}  // namespace cardiac
