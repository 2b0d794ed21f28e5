#pragma once

#include <memory>
#include <vector>

#include <cardiac/contraction/bestel_2001.hpp>
#include <cardiac/heart/wall.hpp>
#include <polyaffine/solve/equilibrium.hpp>

namespace cardiac {

/// When and how strongly each integration point contracts.
struct ContractionField {
  TensionCurve curve;
  polyaffine::Vector delay_ms;  ///< activation time of each point
  polyaffine::Vector scale;     ///< factor on the tension of the curve

  /// Active tension of all points at a time, kPa.
  polyaffine::Vector tension(double time_ms) const;
};

/// A left ventricle assembled from the parts that a protocol names, full order or reduced; parts it does not
/// name are null. Immutable once built.
struct Ventricle {
  std::shared_ptr<const Anatomy> anatomy;
  Discretisation discretisation;
  std::shared_ptr<const polyaffine::FieldEnergy> wall;
  std::shared_ptr<const polyaffine::FieldEnergy> cavity;  ///< its volume, mm³
  std::vector<std::shared_ptr<const polyaffine::FieldEnergy>> springs;
  std::shared_ptr<const ContractionField> contraction;
  BuildCount built;

  int num_coefficients() const { return wall->table().num_unknowns(); }
  double cavity_volume(const polyaffine::Vector& c) const { return cavity->evaluate({c}).value; }
  /// A system with the pattern of the wall, the cavity and the springs.
  std::unique_ptr<polyaffine::LinearSystem> make_system() const;
};

/// Builds what `plan(protocol)` says, from a mesh in mm.
Ventricle build_ventricle(std::shared_ptr<const Anatomy> anatomy, const Protocol& protocol,
                          protocol::Method method);

/// The equilibrium under a cavity pressure and a tension of every point, both ramped with the load parameter.
/// `pressure_kPa` and `tension` belong to λ = 1; the tension must outlive the problem.
polyaffine::EquilibriumProblem loaded_ventricle(const Ventricle& ventricle, double pressure_kPa,
                                                const polyaffine::Vector& tension);

}  // namespace cardiac
