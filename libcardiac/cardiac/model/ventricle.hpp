#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <cardiac/contraction/bestel_2001.hpp>
#include <cardiac/model/muscle.hpp>
#include <cardiac/model/wall.hpp>
#include <polyaffine/system/field_term.hpp>
#include <polyaffine/system/system.hpp>

namespace cardiac {

/// When and how strongly each integration point contracts.
struct ContractionField {
  TensionCurve curve;                  ///< of sarcomeres: their isometric twitch, which tells when they pull
  polyaffine::Vector delay_ms;         ///< activation time of each point
  polyaffine::Vector scale;            ///< factor on the tension of the curve
  polyaffine::Vector vertex_delay_ms;  ///< activation time of each vertex of the mesh
  double begin_ms = 0;                 ///< of contraction, from the excitation of a point

  /// Active tension of all points at a time, kPa.
  polyaffine::Vector tension(double time_ms) const;
};

/// A cavity and the energy of the wall's coefficients that is its volume, mm³.
struct Cavity {
  std::string name;
  std::shared_ptr<const polyaffine::FieldEnergy> volume;
};

/// Makes a term with unknowns of its own (inertia and its velocity), whose block it adds to a layout.
using StateTerm = std::function<std::shared_ptr<const polyaffine::Term>(polyaffine::StateLayout& layout,
                                                                        const scene::Time& time)>;

/// One or two ventricles assembled from the parts that a scene names, full order or reduced; parts it does
/// not name are not there. Immutable once built.
struct Ventricle {
  std::shared_ptr<const Anatomy> anatomy;
  Discretisation discretisation;
  std::shared_ptr<const polyaffine::FieldEnergy> wall;
  std::vector<Cavity> cavities;   ///< in the order of Discretisation::cavities
  polyaffine::Terms supports;     ///< what holds the wall's surfaces
  std::vector<StateTerm> states;  ///< terms with unknowns of their own, for systems in time
  std::shared_ptr<const ContractionField> contraction;
  std::shared_ptr<const Muscle> muscle;         ///< null where tension is a function of time alone
  std::shared_ptr<const Ventricle> all_points;  ///< the same without a trained rule; null where there is none
  std::shared_ptr<const TunedModel> tuned;      ///< that it is made of; null where nothing was learned
  BuildCount built;

  int num_coefficients() const { return wall->table().num_unknowns(); }
  double cavity_volume(const polyaffine::Vector& c, std::size_t cavity = 0) const {
    return cavities.at(cavity).volume->evaluate({c}).value;
  }
  /// Of all cavities, mm³.
  polyaffine::Vector cavity_volumes(const polyaffine::Vector& c) const;
  /// Active tension of every point at a time, kPa; empty where it is no function of time alone.
  polyaffine::PointValues tension() const;
  polyaffine::Vector tension_at(double time_ms) const;
  /// Whose law makes stress of tension: the wall, or the muscle beside it.
  const polyaffine::FieldEnergy& active() const { return muscle ? *muscle->energy : *wall; }
};

/// The cavity behind a surface, on functions.
Cavity cavity_of(const polyaffine::Basis& basis, const CavitySurface& surface);

/// Shape functions and integration points of a scene's model; `trained` points are all their candidates.
Discretisation discretise(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene,
                          scene::Method method);
/// The parts that the scene names, on a discretisation.
Ventricle assemble_ventricle(std::shared_ptr<const Anatomy> anatomy, const Scene& scene,
                             Discretisation discretisation);

/// What loads a wall: pressure of every cavity and active tension of every point (empty: none), kPa.
struct WallLoad {
  polyaffine::Vector pressures_kPa{};
  polyaffine::Vector tension{};
  double resting = 1;  ///< share of the tension of sarcomeres that are held, at the begin of the run

  /// The tension as laws see it; it must outlive that.
  polyaffine::PointState state() const { return {tension.data(), static_cast<std::size_t>(tension.size())}; }
};

/// The equation of a wall and what holds it, without loads, at the active tension τ(t): ∂W/∂c(c, ċ, τ) +
/// supports = 0, over the block "displacement" with a tolerance of time integration.
polyaffine::System wall_system(const Ventricle& ventricle, polyaffine::PointValues tension = {},
                               double tolerance_mm = 0);

/// Adds the terms that have unknowns of their own to a system in time; of `time` the tolerances are read.
void add_states(const Ventricle& ventricle, const scene::Time& time, polyaffine::System& system);
/// Sets the states of sarcomeres to those that last at the drive of a time, for the wall that y describes.
void rest_muscle(const polyaffine::System& system, double time_ms, polyaffine::Vector& y);
/// HeartState::tension_kPa of a state of such a system; empty without sarcomeres.
polyaffine::Vector muscle_tension(const polyaffine::System& system, const polyaffine::Vector& y);

/// The same under pressures p(t) in the cavities, − Σ p ∂V/∂c. Cavities without a pressure have none.
polyaffine::System pressed_system(const Ventricle& ventricle, polyaffine::PointValues tension,
                                  const std::vector<polyaffine::FieldTerm::Scale>& pressures_kPa,
                                  double tolerance_mm = 0);

/// The equilibrium on the straight way between two loads: `from` at t = 0, `to` at t = 1. Tensions are both
/// empty or both of all points.
polyaffine::System loaded_ventricle(const Ventricle& ventricle, const WallLoad& from, const WallLoad& to);

/// The whole load ramped up from zero.
polyaffine::System loaded_ventricle(const Ventricle& ventricle, const WallLoad& load);

}  // namespace cardiac
