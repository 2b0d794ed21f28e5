#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <polyaffine/energy/pressure_space.hpp>
#include <polyaffine/kinematics/packed_block.hpp>
#include <polyaffine/material/law.hpp>
#include <polyaffine/material/viscosity.hpp>
#include <polyaffine/solve/linear_system.hpp>

namespace polyaffine {

/// What an energy is evaluated at. `rate` (the time derivative of c) matters only where there is viscosity.
struct Motion {
  const Vector& c;
  PointState state = {};
  const Vector* rate = nullptr;
};

/// Value, gradient and the range of det M over the points.
struct EnergyValue {
  double value = 0;
  Vector gradient;
  double min_det = 1, max_det = 1;
};

/// W(c) = Σ_q w_q Σ_laws W_law(M_q(c)) + W_vol, over the points of a field table, with gradient
/// f_a = Σ_q w_q P_q row_a and tangent Σ_q w_q B_qᵀ A_q B_q. Units: µJ, mN, mN/mm for the wall; with the
/// signed volume law on a surface table, mm³ and its derivatives.
///
/// The optional pressure space adds the volumetric energy (see PressureSpace); the optional viscosity adds
/// its stress to the gradient (it has no energy) and `rate_factor` times its derivative by the rate to the
/// tangent.
class FieldEnergy {
 public:
  FieldEnergy(FieldTable table, std::vector<std::shared_ptr<const Law>> laws,
              std::optional<PressureSpace> pressure = {}, std::optional<KelvinVoigt> viscosity = {});

  const FieldTable& table() const { return table_; }
  const std::optional<PressureSpace>& pressure_space() const { return pressure_; }

  /// Value and gradient; when min_det ≤ 0 in a wall the numbers are not to be used.
  EnergyValue evaluate(const Motion& motion) const;
  /// Adds scale × tangent to the system. With a pressure space the dependence of the pressure on the
  /// displacement is included; the dependence of viscous stress on c itself is not (it vanishes with the
  /// step).
  void add_tangent(const Motion& motion, LinearSystem& system, double scale = 1,
                   double rate_factor = 0) const;
  /// The pressure coefficients (kPa) of the pressure space at c.
  Vector pressure(const Vector& c) const;

 private:
  struct Kinematics;
  Kinematics kinematics(const Motion& motion) const;
  void respond(const Kinematics& kin, const Motion& motion, std::size_t k, const Vector& pressure, int pack,
               bool tangent, double rate_factor, PackResponse& r) const;
  Vector point_pressure(const Kinematics& kin, std::size_t k) const;

  FieldTable table_;
  std::vector<std::shared_ptr<const Law>> laws_;
  std::optional<PressureSpace> pressure_;
  std::optional<KelvinVoigt> viscosity_;
  InverseMass inverse_mass_;
  std::vector<PackedBlock> packed_;
  std::vector<int> first_pack_;  // of each block, and their number
};

}  // namespace polyaffine
