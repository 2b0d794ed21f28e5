#pragma once

#include <optional>

#include <cardiac/reduction/nested_space.hpp>
#include <cardiac/training/full_order.hpp>

namespace cardiac {

/// What a nested model needs to tell the error of its own states: functions beyond its own. An error is the
/// correction that Newton's method would make in the larger space,
///   δ = −(K + κ DᵀM⁻¹D)⁻¹ (Φᵀ r + κ DᵀM⁻¹ r_p),
/// r being the force that the full-order model finds at the state, r_p its changes of volume, Φ the
/// functions, K and D by the points of the model (hierarchical estimates: Bank and Smith 1993), times a
/// factor that states held out have taught.
struct ErrorCheck {
  NestedSpace space;  ///< the model's modes and pressures are its first
  polyaffine::Matrix pressure_mass;
  double factor =
      1;  ///< true over estimated error, the geometric mean over held-out states of other segments
};

/// A state of a nested model under a load.
struct NestedState {
  TrainingLoad load;
  polyaffine::Vector c, pressure;  ///< coefficients; mm, kPa
};

/// The error of a state, estimated: factor · ‖δ‖ / ‖u‖ in L2 over the wall. None where the larger model is
/// not stable there. `full` is the full-order model with the load's regions, `larger` the same with the
/// functions of the check and the points of the model.
std::optional<double> estimated_error(const ErrorCheck& check, const Ventricle& larger, const Ventricle& full,
                                      const NestedState& state);

}  // namespace cardiac
