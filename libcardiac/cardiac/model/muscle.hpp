#pragma once

#include <memory>
#include <vector>

#include <cardiac/contraction/sarcomere.hpp>
#include <cardiac/tissue/fibre_axes.hpp>
#include <polyaffine/system/field_energy.hpp>
#include <polyaffine/system/term.hpp>

namespace cardiac {

/// Muscle whose tension feels its fibres: a sarcomere at each integration point of the wall.
struct Muscle {
  std::shared_ptr<const SarcomereModel> sarcomere;
  std::shared_ptr<const polyaffine::FieldEnergy> energy;  ///< one law, ActiveStress
  polyaffine::Points fibres;                              ///< f of each point, 3 × points
  polyaffine::Vector delay_ms, scale;                     ///< excitation, and factor on the tension

  int num_points() const { return static_cast<int>(fibres.cols()); }
  /// SarcomereModel::drive of each point at a time.
  polyaffine::Vector drive(double time_ms) const;
};

/// λ = |F f| of each point, ∂λ/∂F (9 × points, entry iJ at i + 3J) and, where something moves, λ̇ (1/ms).
struct FibreStretch {
  polyaffine::Vector stretch, rate;
  polyaffine::Matrix by_F;
};
FibreStretch fibre_stretch(const Muscle& muscle, const polyaffine::Vector& c,
                           const polyaffine::Vector* rate = nullptr);

/// The muscle in time. The states z of its points are unknowns of a block "contraction" of their own that it
/// adds to a layout, with the residual ż − g(d(t), λ, λ̇, z); the field feels the second
/// Piola–Kirchhoff stress τ = T/λ along the fibre (ActiveStress). They are solved
/// apart, point by point: with M = α − ∂g/∂z and h = ∂g/∂λ + α ∂g/∂λ̇,
///   δz = M⁻¹ (ρ_z + h δλ),  dT/dλ = ∂T/∂λ + ∂T/∂z M⁻¹ h
/// is what the tangent sees, so that stretch and its rate are implicit in a
/// step of any length. How λ̇ changes with F at a fixed Ḟ is left out of the tangent, as it vanishes with the
/// step.
class MuscleTerm : public polyaffine::Term {
 public:
  MuscleTerm(std::shared_ptr<const Muscle> muscle, polyaffine::StateLayout& layout);

  void add_residual(const polyaffine::At& at, polyaffine::Residual& out) const override;
  void add_tangent(const polyaffine::At& at, double alpha, polyaffine::Tangent& out) const override;
  void add_tables(std::vector<const polyaffine::FieldTable*>& out) const override;

  /// States that last at the drive of a time, the wall being held.
  void rest(double time_ms, polyaffine::Vector& y) const;
  /// τ = T/λ of each point, kPa, with its factor.
  polyaffine::Vector tension(const polyaffine::Vector& y) const;

 private:
  class EliminatedStates;
  SarcomereModel::States states(const polyaffine::Vector& y, int point) const;

  std::shared_ptr<const Muscle> muscle_;
  int num_states_;
  polyaffine::Unknowns c_, z_;
};

/// The muscle in equilibrium: its states follow the stretch, at the drive of a time. Its tension is
/// multiplied by a share that goes from one number to another with t from 0 to 1.
class RestingMuscle : public polyaffine::Term {
 public:
  RestingMuscle(std::shared_ptr<const Muscle> muscle, double time_ms, double from = 1, double to = 1);

  void add_residual(const polyaffine::At& at, polyaffine::Residual& out) const override;
  void add_tangent(const polyaffine::At& at, double alpha, polyaffine::Tangent& out) const override;
  void add_tables(std::vector<const polyaffine::FieldTable*>& out) const override;

 private:
  polyaffine::Vector tension_and_stiffness(double t, const polyaffine::Vector& c) const;

  std::shared_ptr<const Muscle> muscle_;
  polyaffine::Vector drive_;
  double from_, to_;
  polyaffine::Unknowns c_;
};

}  // namespace cardiac
