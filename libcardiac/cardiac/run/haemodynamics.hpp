#pragma once

#include <cardiac/run/beat.hpp>

namespace cardiac {

/// What the last beat of a path means for the circulation of one ventricle (0 left, 1 right): integrals by
/// the trapezoidal rule over HeartPath::circulation, pressure rates over time steps. None unless the beat is
/// whole.
std::optional<Haemodynamics> haemodynamics(const HeartPath& path, const Scene& scene, int cavity);

/// What flowed through every compliance in the last beat, by the same rule. Empty unless the beat is whole.
std::vector<FlowBalance> flow_balances(const HeartPath& path, const Scene& scene);

/// The pressures, volumes and flows of HeartPath::circulation with their names; empty without circulation.
CirculationTable circulation_table(const HeartPath& path, const Scene& scene);

}  // namespace cardiac
