#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <polyaffine/kinematics/packed_block.hpp>
#include <polyaffine/linear/linear_system.hpp>
#include <polyaffine/material/law.hpp>
#include <polyaffine/system/pressure_space.hpp>
#include <polyaffine/system/volume_gradient.hpp>

namespace polyaffine {

/// What an energy is evaluated at. `rate` (the time derivative of c) matters only to laws that feel it.
/// `pressure` makes the coefficients of the pressure space independent (mixed form); without it they follow
/// the displacement, p = κ M⁻¹ g(c) (condensed form).
struct Motion {
  const Vector& c;
  PointState state = {};
  const Vector* rate = nullptr;
  const Vector* pressure = nullptr;
};

/// Value, gradient by c and the range of det M over the points; in the mixed form also the gradient by the
/// pressures, g − M p/κ (mm³), or g where the space is incompressible.
struct EnergyValue {
  double value = 0;
  Vector gradient;
  Vector pressure_gradient;
  double min_det = 1, max_det = 1;
};

/// The terms of an EnergyValue's sums over the points, a column (of `value`: a number) for each point. They
/// sum to the gradient; in the mixed form also to the pressure gradient; `value` holds the energy of the
/// laws.
struct PointTerms {
  Vector value;
  Matrix gradient;           ///< unknowns × points
  Matrix pressure_gradient;  ///< pressures × points
};

/// W(c) = Σ_q w_q Σ_laws W_law(M_q(c)) + W_vol, over the points of a field table, with gradient
/// f_a = Σ_q w_q P_q row_a and tangent Σ_q w_q B_qᵀ A_q B_q. Units: µJ, mN, mN/mm for the wall; with the
/// signed volume law on a surface table, mm³ and its derivatives.
///
/// The optional pressure space adds the volumetric energy (see PressureSpace). Laws that feel the rate
/// (viscosity) add their stress to the gradient and `rate_factor` times its derivative by the rate to the
/// tangent.
class FieldEnergy {
 public:
  FieldEnergy(FieldTable table, std::vector<std::shared_ptr<const Law>> laws,
              std::optional<PressureSpace> pressure = {});

  const FieldTable& table() const { return table_; }
  const std::optional<PressureSpace>& pressure_space() const { return pressure_; }
  /// Those that do not feel the rate, and those that do.
  const std::vector<std::shared_ptr<const Law>>& laws() const { return laws_; }
  const std::vector<std::shared_ptr<const Law>>& viscous_laws() const { return viscous_; }
  bool feels_rate() const { return !viscous_.empty(); }
  /// The blocks of the table as they are summed over.
  const std::vector<PackedBlock>& blocks() const { return packed_; }

  /// Value and gradient; when min_det ≤ 0 in a wall the numbers are not to be used.
  EnergyValue evaluate(const Motion& motion) const;
  /// What each point contributes, for the choice of fewer points (CubatureTraining).
  PointTerms point_terms(const Motion& motion) const;
  /// Adds scale × tangent to the system, K(c, p) + κ DᵀM⁻¹D with D = ∂g/∂c: the exact tangent of the
  /// condensed form, and in the mixed form that of Newton's method after its pressure step is eliminated. The
  /// dependence of viscous stress on c itself is not included (it vanishes with the step). With a pressure
  /// space D is returned, for whoever eliminates the pressures.
  VolumeGradient add_tangent(const Motion& motion, LinearSystem& system, double scale = 1,
                             double rate_factor = 0) const;
  /// The pressure coefficients (kPa) of the condensed form at c.
  Vector pressure(const Vector& c) const;

  /// Parts of the mixed form, for an energy with a pressure space: κ M⁻¹ g and D(c).
  Vector penalty_pressure(const Vector& g) const;
  VolumeGradient volume_gradient(const Vector& c) const;

 private:
  // Neighbouring packs of a block: few enough that their rows stay in the cache from F to the forces.
  struct Slice {
    std::size_t block;
    PackRange packs;
  };
  struct Kinematics;
  Kinematics room(const Motion& motion) const;
  void move(const Motion& motion, const Slice& slice, Kinematics& kin) const;
  Kinematics kinematics(const Motion& motion) const;
  void respond(const Kinematics& kin, const Motion& motion, std::size_t k, const double* pressure, int pack,
               bool tangent, double rate_factor, PackResponse& r) const;
  Slice whole(std::size_t k) const { return {k, packed_[k].all()}; }
  Vector point_pressure(const Vector& p, const Slice& slice) const;

  FieldTable table_;
  std::vector<std::shared_ptr<const Law>> laws_, viscous_;  // those that feel the rate apart
  std::optional<PressureSpace> pressure_;
  InverseMass inverse_mass_;
  std::vector<PackedBlock> packed_;
  std::vector<int> first_pack_;  // of each block, and their number
  std::vector<Slice> slices_;    // of all blocks
};

}  // namespace polyaffine
