#pragma once

#include <functional>
#include <optional>

#include <polyaffine/system/field_energy.hpp>
#include <polyaffine/system/point_values.hpp>
#include <polyaffine/system/term.hpp>

namespace polyaffine {

/// The force s(t) ∂E/∂c (c, ċ; state(t)) of an energy of the field of a system: a solid, or a load on a
/// surface. Its pressures, if it has a pressure space, follow the displacement (p = κ M⁻¹ g), or in the mixed
/// form are unknowns with the residual g − M p/κ that are solved apart: with D = ∂g/∂c
///   (K + κ DᵀM⁻¹D) δc = ρ_c + κ DᵀM⁻¹ρ_p,  δp = κ M⁻¹(D δc − ρ_p),
/// so that stiff volumes cost no more of Newton's iterations than soft ones, and a tangent serves as long.
class FieldTerm : public Term {
 public:
  using Scale = std::function<double(double t)>;

  /// `is_solid`: the field is a deformation gradient, whose determinant must stay positive. An empty scale is
  /// 1; an empty state is none.
  FieldTerm(std::shared_ptr<const FieldEnergy> energy, bool is_solid, Scale scale = {},
            PointValues state = {});

  void add_residual(const At& at, Residual& out) const override;
  void add_tangent(const At& at, double alpha, Tangent& out) const override;
  /// Of its laws that feel neither state nor rate, with the pressure space; and of those that feel the rate
  /// (PointStress). An energy with a scale is a load, which stores and loses nothing.
  double stored_energy(const At& at) const override;
  double dissipation(const At& at) const override;
  std::shared_ptr<const Term> mixed(StateLayout& layout) const override;
  void start(Vector& y, Vector* rate = nullptr) const override;
  std::optional<double> strain(const Vector& step) const override;
  void add_tables(std::vector<const FieldTable*>& out) const override;

  const FieldEnergy& energy() const { return *energy_; }

 private:
  double scale(double t) const { return scale_ ? scale_(t) : 1; }

  std::shared_ptr<const FieldEnergy> energy_;
  bool is_solid_;
  Scale scale_;
  PointValues state_;
  Unknowns c_;
  std::optional<Unknowns> pressures_;
};

/// The energy of a body, with the state of its points (an active tension) at a time.
std::shared_ptr<const Term> solid(std::shared_ptr<const FieldEnergy> energy, PointValues state = {});
/// An energy that loads or holds a body, such as that of a pressure p(t) with the volume it encloses and
/// s = −p, or of springs.
std::shared_ptr<const Term> load(std::shared_ptr<const FieldEnergy> energy, FieldTerm::Scale scale = {});

}  // namespace polyaffine
