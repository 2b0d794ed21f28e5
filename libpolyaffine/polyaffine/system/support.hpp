#pragma once

#include <polyaffine/material/springs.hpp>
#include <polyaffine/system/field_energy.hpp>
#include <polyaffine/system/term.hpp>

namespace polyaffine {

/// What holds a surface: a spring of stiffness k (kPa/mm) and a dashpot of damping η (kPa·ms/mm) at every
/// point.
struct SupportParameters {
  double stiffness_kPa_per_mm = 0;
  double damping_kPa_ms_per_mm = 0;
  /// Unit normals of the reference surface, one a point (3 × points): the support acts along them alone, or
  /// across them alone. Empty: in all directions.
  Points normals = {};
  SpringDirection direction = SpringDirection::along_normal;
};

/// The traction −k u − η u̇ on a surface, or its part along the normals, −(k u·n + η u̇·n) n, or that across
/// them; parameters "stiffness" and "damping". A surface that is held by both everywhere is a Robin boundary
/// (Pfaller et al. 2019, Biomech Model Mechanobiol 18:503).
class Support : public Term {
 public:
  /// `surface`: the displacement table of the surface. Throws InputError when a parameter is negative.
  Support(FieldTable surface, SupportParameters parameters);

  void add_residual(const At& at, Residual& out) const override;
  void add_tangent(const At& at, double alpha, Tangent& out) const override;
  /// k/2 ∫ |u|² and η ∫ |u̇|², of what the support feels of u.
  double stored_energy(const At& at) const override;
  double dissipation(const At& at) const override;
  std::vector<std::string> parameters() const override { return {"stiffness", "damping"}; }
  void add_parameter_derivative(const std::string& parameter, const At& at, Vector& out) const override;
  void add_tables(std::vector<const FieldTable*>& out) const override;

 private:
  EnergyValue force(const Vector& u) const;

  FieldEnergy unit_;  // of springs of stiffness 1 kPa/mm: both forces are linear in what they depend on
  Matrix matrix_;     // of them, where it is smaller than the table; else empty
  double stiffness_, damping_;
  Unknowns c_;
};

}  // namespace polyaffine
