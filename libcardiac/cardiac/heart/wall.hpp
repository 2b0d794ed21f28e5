#pragma once

#include <memory>
#include <vector>

#include <cardiac/heart/discretisation.hpp>
#include <cardiac/protocol/protocol.hpp>
#include <polyaffine/energy/field_energy.hpp>

namespace cardiac {

/// Factor of each segment at points of the wall: the product of the overrides that hold there, each blended to 1 over
/// its border by the distance (in coordinates of the segment's size) to the overridden segments.
struct RegionFactors {
  std::vector<double> stiffness, tension;
  polyaffine::Vector delay_ms;
};
RegionFactors region_factors(const Anatomy& anatomy, const Protocol& protocol, const polyaffine::WallPoints& points);

/// The wall as an energy over its integration points: passive law, volumetric part, active stress and viscosity, each
/// only where the protocol has it.
std::shared_ptr<const polyaffine::FieldEnergy> build_wall(const Anatomy& anatomy, const Protocol& protocol,
                                                          const Discretisation& discretisation,
                                                          const RegionFactors& factors);

}  // namespace cardiac
