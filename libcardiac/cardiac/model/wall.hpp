#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/fibres/helix.hpp>
#include <cardiac/reduction/discretisation.hpp>
#include <cardiac/scene/scene.hpp>
#include <polyaffine/system/field_energy.hpp>

namespace cardiac {

/// The angles of a scene's fibres.
HelixAngles helix_angles(const scene::Fibres& fibres);

/// Axes f, s, n at points of the wall: the anatomy's own fibres, or the scene's rule. Throws InputError
/// when the scene wants those of the file and the anatomy has none.
FibreAxes fibres_at(const Anatomy& anatomy, const scene::Fibres& fibres, const std::vector<int>& tet,
                    const Eigen::Matrix4Xd& barycentric);

/// Fibre directions at the centroids of the tets, 3 × tets.
polyaffine::Points tet_fibres(const Anatomy& anatomy, const scene::Fibres& fibres);

/// How often the builder of each part ran; a part that is not in it was not built.
using BuildCount = std::map<std::string, int>;

/// What the region overrides of a scene make of each point of the wall: the product of their factors and
/// the sum of their delays, each blended to nothing over its border by the share of its segments. Empty
/// without overrides.
struct RegionFactors {
  std::vector<double> stiffness, tension, delay_ms;
};
RegionFactors region_factors(const Anatomy& anatomy, const Scene& scene,
                             const polyaffine::WallPoints& points);

/// The wall as an energy over its integration points: passive law, volumetric part, active stress and
/// viscosity, each only where the scene has it.
std::shared_ptr<const polyaffine::FieldEnergy> build_wall(const Anatomy& anatomy, const Scene& scene,
                                                          const Discretisation& discretisation,
                                                          const RegionFactors& factors, BuildCount& built);

}  // namespace cardiac
