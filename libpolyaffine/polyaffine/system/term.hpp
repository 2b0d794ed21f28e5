#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <polyaffine/kinematics/field_table.hpp>
#include <polyaffine/linear/linear_system.hpp>
#include <polyaffine/system/state.hpp>

namespace polyaffine {

/// Where the terms of a system are looked at: a time (ms; of a static path the load parameter, 0 to 1), all
/// unknowns y and their rates ẏ, null where nothing moves.
struct At {
  double t;
  const Vector& y;
  const Vector* rate = nullptr;

  /// The rates of some unknowns; zeros where nothing moves.
  Vector rate_of(Unknowns u) const { return rate ? Vector(u.of(*rate)) : Vector(Vector::Zero(u.size)); }
};

/// What the terms of a system say to a state; every term adds its own.
struct Residual {
  Vector values;         ///< R, by unknown; forces (mN) where the unknown is a displacement
  double potential = 0;  ///< energy (µJ) of what has one
  double forces = 0;  ///< Σ ‖force on the field‖ over the terms: what the sum of forces is small against
  /// The largest defect, without unit, of the equations that are no forces: a change of volume, a rate.
  double defect = 0;
  double min_det = std::numeric_limits<double>::infinity();   ///< range of det F over the points of solids
  double max_det = -std::numeric_limits<double>::infinity();  ///< (turned about without a solid)

  bool admissible() const { return min_det > 0 && values.allFinite() && potential - potential == 0; }
};

/// Unknowns z that a term solves apart, eliminated from a tangent by it: Newton's corrections obey
///   K δc = ρ_c + condense(ρ),  δz = recover(δc, ρ),
/// ρ being the right-hand side (−R) and K the tangent of the field with z eliminated.
class Elimination {
 public:
  virtual ~Elimination() = default;
  /// Adds to the right-hand side of the field.
  virtual void condense(const Vector& rhs, Eigen::Ref<Vector> field) const = 0;
  /// Sets the unknowns z of the step.
  virtual void recover(const Vector& rhs, Vector& step) const = 0;
};

/// ∂R/∂y + α ∂R/∂ẏ in the parts by which it is solved; every term adds its own. Rows and columns of `few`
/// unknowns are numbered by few_index.
struct Tangent {
  const StateLayout& layout;
  LinearSystem& field;  ///< of the field; unknowns that a term solves apart are eliminated by it
  struct Line {
    int few;
    Vector by_field;
  };
  std::vector<Line> columns;                                          ///< ∂R_field/∂(a few unknown)
  std::vector<Line> rows;                                             ///< ∂R_(a few unknown)/∂field
  Matrix corner;                                                      ///< few × few
  std::vector<std::unique_ptr<const Elimination>> eliminations = {};  ///< none outlives its term

  int few_index(int unknown) const { return layout.few_index(unknown); }
};

/// One effect of an equation of motion Σ_terms R(t, y, ẏ) = 0: a residual, its derivative, and parameters.
/// Terms are immutable, so that several solvers may look at the same.
class Term {
 public:
  virtual ~Term() = default;

  virtual void add_residual(const At& at, Residual& out) const = 0;
  /// Adds ∂R/∂y + α ∂R/∂ẏ (α in 1/ms), with an Elimination of the unknowns that the term solves apart.
  virtual void add_tangent(const At& at, double alpha, Tangent& out) const = 0;

  /// Whether the term knows but `few` unknowns and bends so sharply (valves) that Newton's method is to meet
  /// it as it is, instead of its tangent.
  virtual bool is_met_exactly() const { return false; }

  /// Names of the parameters that the term can be differentiated by.
  virtual std::vector<std::string> parameters() const { return {}; }
  /// Adds ∂R/∂(parameter), a force a unit of the parameter. Throws std::invalid_argument for another name.
  virtual void add_parameter_derivative(const std::string& parameter, const At& at, Vector& out) const;

  /// Energy that the term stores, µJ: elastic, or of the motion ẏ. Of the unknowns only the field is read;
  /// the pressures of a mixed form are those that belong to the displacement.
  virtual double stored_energy(const At& at) const;
  /// Power that the term turns into heat, µJ/ms, read of the field alone as well.
  virtual double dissipation(const At& at) const;

  /// The term with independent pressures, in a block of its own that is added to the layout; null where it
  /// has none. `start` sets them, and their rates where something moves, to those that belong to the
  /// displacement.
  virtual std::shared_ptr<const Term> mixed(StateLayout& layout) const;
  virtual void start(Vector& y, Vector* rate = nullptr) const;

  /// The largest change of a deformation gradient that a step of the field makes; none where the term is no
  /// solid.
  virtual std::optional<double> strain(const Vector& step) const;
  /// The tables whose functions the term couples: the pattern of a sparse tangent.
  virtual void add_tables(std::vector<const FieldTable*>& out) const;
};

using Terms = std::vector<std::shared_ptr<const Term>>;

}  // namespace polyaffine
