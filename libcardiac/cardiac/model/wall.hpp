#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <cardiac/fibres/helix.hpp>
#include <cardiac/protocol/protocol.hpp>
#include <cardiac/reduction/discretisation.hpp>
#include <polyaffine/system/field_energy.hpp>

namespace cardiac {

/// The angles of a protocol's fibres.
HelixAngles helix_angles(const protocol::Fibres& fibres);

/// Axes f, s, n at points of the wall: the anatomy's own fibres, or the protocol's rule. Throws InputError
/// when the protocol wants those of the file and the anatomy has none.
FibreAxes fibres_at(const Anatomy& anatomy, const protocol::Fibres& fibres, const std::vector<int>& tet,
                    const Eigen::Matrix4Xd& barycentric);

/// Fibre directions at the centroids of the tets, 3 × tets.
polyaffine::Points tet_fibres(const Anatomy& anatomy, const protocol::Fibres& fibres);

/// How often the builder of each part ran; a part that is not in it was not built.
using BuildCount = std::map<std::string, int>;

/// What the region overrides of a protocol make of each point of the wall: the product of their factors and
/// the sum of their delays, each blended to nothing over its border by the share of its segments. Empty
/// without overrides.
struct RegionFactors {
  std::vector<double> stiffness, tension, delay_ms;
};
RegionFactors region_factors(const Anatomy& anatomy, const Protocol& protocol,
                             const polyaffine::WallPoints& points);

/// The wall as an energy over its integration points: passive law, volumetric part, active stress and
/// viscosity, each only where the protocol has it.
std::shared_ptr<const polyaffine::FieldEnergy> build_wall(const Anatomy& anatomy, const Protocol& protocol,
                                                          const Discretisation& discretisation,
                                                          const RegionFactors& factors, BuildCount& built);

}  // namespace cardiac
