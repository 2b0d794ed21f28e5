#pragma once

#include <memory>

#include <cardiac/circulation/circulation_model.hpp>
#include <cardiac/core/heart_state.hpp>
#include <cardiac/model/ventricle.hpp>
#include <polyaffine/system/linearised.hpp>

namespace cardiac {

/// The wall, its cavities and their circulation as one equation in time over y = [c, V, z, p]: coefficients,
/// volumes of the cavities, other states of the circulation (pressures of vessels, volumes of chambers,
/// flows) and pressures of the cavities,
///   ∂W/∂c(c, ċ, τ(t)) + supports − Σ p ∂V/∂c = 0,  V − V(c) = 0,  [V̇, ż] = f(t, V, z, p).
struct CoupledHeart {
  polyaffine::System system;
  polyaffine::Unknowns displacement, volumes, vessels, pressures;
  std::shared_ptr<const CirculationModel> circulation;

  int num_cavities() const { return volumes.size; }
  /// Of the circulation: V, then z.
  polyaffine::Vector states(const polyaffine::Vector& y) const;

  polyaffine::Vector pack(const HeartState& state) const;
  HeartState unpack(double time_ms, const polyaffine::Vector& y) const;
};

/// Couples a ventricle with a circulation of as many cavities. Of `time` the tolerances are read. The
/// pressures of cavities are left out of the error test: while its valves are closed, that of a cavity is the
/// multiplier of its constant volume.
CoupledHeart couple(const Ventricle& ventricle, std::shared_ptr<const CirculationModel> circulation,
                    const scene::Time& time);

/// Changes the cavity pressures of y by the viscous pressures δ of the flows that the valves let through, and
/// the rates with them, so that the residual vanishes: with Z = C⁻¹ ∂V/∂c and C the viscous tangent, ċ moves
/// by Z δ and V̇ by (∂V/∂c)ᵀZ δ, to the flows of the circulation at p + δ, solved by Newton's method. From a
/// wall in static equilibrium at rest this is how a beat begins, and from one in motion how it goes on after
/// the vessels' pressures were changed. Without viscosity δ = 0 and ċ is the elastic motion at the rate V̇. On
/// failure (a singular tangent) the wall keeps its motion. `linear` is of the heart's system
/// (System::make_linear). Returns what it took.
polyaffine::SystemCost make_consistent(const CoupledHeart& heart, polyaffine::LinearSystem& linear, double t,
                                       polyaffine::Vector& y, polyaffine::Vector& rate);

}  // namespace cardiac
