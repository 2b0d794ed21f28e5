#pragma once

#include <array>

#include <polyaffine/core/types.hpp>

namespace cardiac {

/// What drives a fibre at an instant.
struct FibreMotion {
  double drive = 0;        ///< what excitation makes, SarcomereModel::drive
  double stretch = 1;      ///< λ, dimensionless
  double rate_per_ms = 0;  ///< λ̇
};

inline constexpr int kMostSarcomereStates = 6;

/// Tension and rates of the states of one fibre, with their derivatives.
struct SarcomereResponse {
  using States = std::array<double, kMostSarcomereStates>;

  double tension_kPa = 0;  ///< T, force over the reference area; the power it takes is T λ̇
  double by_stretch = 0;
  States by_state{};
  States rates{};  ///< ż, 1/ms
  States rates_by_stretch{}, rates_by_rate{};
  std::array<States, kMostSarcomereStates> rates_by_state{};  ///< [i][j] = ∂ż_i/∂z_j
};

/// A contraction that feels its fibre: states z of a point, without unit and of the order of one, with
///   ż = g(d(t), λ, λ̇, z),  T = T(λ, z),
/// driven by d, a function of the time since the excitation of the point.
/// Models are immutable.
class SarcomereModel {
 public:
  using States = SarcomereResponse::States;

  virtual ~SarcomereModel() = default;
  virtual int num_states() const = 0;
  virtual double period_ms() const = 0;
  /// d at a time since excitation, which repeats with the period.
  virtual double drive(double since_ms) const = 0;
  /// Sets all that the model has in a response; the derivatives only if asked for.
  virtual void respond(const FibreMotion& at, const States& z, bool derivatives,
                       SarcomereResponse& r) const = 0;
  /// States that last while drive and stretch are held, g(d, λ, 0, z) = 0.
  virtual States at_rest(double drive, double stretch) const = 0;
};

/// The overlap of the filaments over the stretch,
///   h(λ) = max(0, 1 + β₀ (ℓ + min(ℓ, 0.87) − 1.87)),  ℓ = min(λ, 1.2),
/// which is 1 at λ = 1, with its derivative. Source: Land et al. 2017, eq. 3.
struct Overlap {
  double value, slope;
};
Overlap filament_overlap(double stretch, double beta0);

/// T, dT/dλ of a fibre that is held: the states follow the stretch, g(d, λ, 0, z) = 0.
struct RestingTension {
  double tension_kPa, by_stretch;
};
RestingTension resting_tension(const SarcomereModel& model, double drive, double stretch);

}  // namespace cardiac
