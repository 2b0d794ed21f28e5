#pragma once

#include <polyaffine/system/field_energy.hpp>
#include <polyaffine/system/term.hpp>

namespace polyaffine {

/// The inertia of a body, ∫ ρ N_a ü dV, with the velocity as a block of its own that it solves apart:
///   R_c = M v̇,  R_v = ċ − v;  with a tangent by α: (K + αC + α²M) δc = ρ_c + α M ρ_v,  δv = α δc − ρ_v.
/// The error test of time integration leaves the velocity out: where a constraint holds the displacement (a
/// closed cavity) it is a multiplier's neighbour, of index 2. Parameter "density".
class Inertia : public Term {
 public:
  /// `body`: the displacement table of points that integrate products of two functions; `density` ρ in mg/mm³
  /// (= g/mL), so that M v̇ is in mN. Adds the block "velocity" (mm/ms) with a tolerance of time integration
  /// to the layout. Throws InputError unless ρ > 0.
  Inertia(FieldTable body, double density, double velocity_tolerance, StateLayout& layout);

  void add_residual(const At& at, Residual& out) const override;
  void add_tangent(const At& at, double alpha, Tangent& out) const override;
  /// ½ ∫ ρ |u̇|².
  double stored_energy(const At& at) const override;
  std::vector<std::string> parameters() const override { return {"density"}; }
  void add_parameter_derivative(const std::string& parameter, const At& at, Vector& out) const override;
  void add_tables(std::vector<const FieldTable*>& out) const override;

  Unknowns velocity() const { return v_; }

 private:
  class EliminatedVelocity;
  Vector momentum(const Vector& v) const { return mass_.evaluate({v}).gradient; }

  FieldEnergy mass_;  // ½ ∫ ρ |v|²
  double density_;
  Unknowns c_, v_;
};

}  // namespace polyaffine
