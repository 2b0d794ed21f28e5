#pragma once

#include <memory>

#include <polyaffine/system/field_energy.hpp>
#include <polyaffine/system/term.hpp>

namespace cardiac {

/// A cavity whose volume V and pressure p are unknowns: the pressure pushes the wall, and V is the volume
/// that the wall encloses,
///   R_c = −p ∂V(c)/∂c,  R_V = V − V(c);
/// what relates V to p (a circulation) is a term of its own.
class CavityCoupling : public polyaffine::Term {
 public:
  /// `enclosed`: V(c) in mm³ as an energy of the field; the unknowns are one number each.
  CavityCoupling(std::shared_ptr<const polyaffine::FieldEnergy> enclosed, polyaffine::Unknowns volume,
                 polyaffine::Unknowns pressure);

  void add_residual(const polyaffine::At& at, polyaffine::Residual& out) const override;
  void add_tangent(const polyaffine::At& at, double alpha, polyaffine::Tangent& out) const override;
  void add_tables(std::vector<const polyaffine::FieldTable*>& out) const override;

 private:
  std::shared_ptr<const polyaffine::FieldEnergy> enclosed_;
  polyaffine::Unknowns c_, volume_, pressure_;
};

}  // namespace cardiac
