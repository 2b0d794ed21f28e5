#pragma once

#include <memory>
#include <vector>

#include <cardiac/contraction/bestel_2001.hpp>
#include <cardiac/model/wall.hpp>
#include <polyaffine/solve/equilibrium.hpp>

namespace cardiac {

/// When and how strongly each integration point contracts.
struct ContractionField {
  TensionCurve curve;
  polyaffine::Vector delay_ms;         ///< activation time of each point
  polyaffine::Vector scale;            ///< factor on the tension of the curve
  polyaffine::Vector vertex_delay_ms;  ///< activation time of each vertex of the mesh

  /// Active tension of all points at a time, kPa.
  polyaffine::Vector tension(double time_ms) const;
};

/// One or two ventricles assembled from the parts that a protocol names, full order or reduced; parts it does
/// not name are null. Immutable once built.
struct Ventricle {
  std::shared_ptr<const Anatomy> anatomy;
  Discretisation discretisation;
  std::shared_ptr<const polyaffine::FieldEnergy> wall;
  std::shared_ptr<const polyaffine::FieldEnergy> cavity;        ///< of the left ventricle: its volume, mm³
  std::shared_ptr<const polyaffine::FieldEnergy> right_cavity;  ///< null without a right ventricle
  std::vector<std::shared_ptr<const polyaffine::FieldEnergy>> springs;
  std::shared_ptr<const ContractionField> contraction;
  std::shared_ptr<const Ventricle> all_points;  ///< the same without a trained rule; null where there is none
  BuildCount built;

  int num_coefficients() const { return wall->table().num_unknowns(); }
  double cavity_volume(const polyaffine::Vector& c) const { return cavity->evaluate({c}).value; }
  /// The cavities that there are, left before right.
  std::vector<const polyaffine::FieldEnergy*> cavities() const;
  /// A system with the pattern of the wall, the cavities and the springs.
  std::unique_ptr<polyaffine::LinearSystem> make_system() const;
};

/// Shape functions and integration points of a protocol's model; `trained` points are all their candidates.
Discretisation discretise(const std::shared_ptr<const Anatomy>& anatomy, const Protocol& protocol,
                          protocol::Method method);
/// The parts that the protocol names, on a discretisation.
Ventricle assemble_ventricle(std::shared_ptr<const Anatomy> anatomy, const Protocol& protocol,
                             Discretisation discretisation);

/// What loads a wall: cavity pressure and active tension of every point (empty: none), kPa.
struct WallLoad {
  double pressure_kPa = 0;
  polyaffine::Vector tension{};
  double right_pressure_kPa = 0;
};

/// The equilibrium on the straight way between two loads: `from` at load parameter 0, `to` at 1. Tensions are
/// both empty or both of all points.
polyaffine::EquilibriumProblem loaded_ventricle(const Ventricle& ventricle, const WallLoad& from,
                                                const WallLoad& to);

/// The whole load ramped up from zero.
polyaffine::EquilibriumProblem loaded_ventricle(const Ventricle& ventricle, const WallLoad& load);

}  // namespace cardiac
