#pragma once

#include <optional>

#include <cardiac/core/beat_result.hpp>
#include <cardiac/run/beat.hpp>

namespace cardiac {

/// The energy of the last beat of a path, or of a contraction under given pressures or volumes, from its time
/// steps n at the model's own integration points q, each term on its own:
///   active      −Σ_n Σ_q w ½ (P_n + P_n+1) : (F_n+1 − F_n), P the stress of the active tension,
///   cavities    −Σ_n Σ ½ (p_n + p_n+1) (V_n+1 − V_n),
///   elastic     the energies of the laws and of the pressure space at the end less those at the begin,
///   supports    the same of springs; kinetic: of the motion, ċ of the parabola through three steps,
///   viscosity   Σ_n Σ_q w P(F̄, Ḟ) : Ḟ Δt and dashpots likewise, with F̄ = ½ (F_n + F_n+1), Ḟ = (F_n+1 −
///   F_n)/Δt.
/// Active work, cavities and losses are of second order in the steps. None without contraction, or of a path
/// of fewer than three steps.
std::optional<EnergyBalance> energy_balance(const Ventricle& ventricle, const scene::Time& time,
                                            const HeartPath& path);

}  // namespace cardiac
