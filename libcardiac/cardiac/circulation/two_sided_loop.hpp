#pragma once

#include <cardiac/circulation/circulation_model.hpp>

namespace cardiac {

/// The closed circulation of two ventricles: each empties through its outlet valve into a windkessel, which
/// empties into the veins before the other ventricle; veins and atrium together are one compliance,
///   V̇ = q_in − q_out,  C_a ṗ_a = q_out − (p_a − p_v)/R,  C_v ṗ_v = (p_a − p_v)/R − q_in of the other side,
/// with the valves q_in(p_v − p) and q_out(p − p_a), the outlet in series with the windkessel's proximal
/// resistance. No blood is lost: Σ V + Σ C p is constant. Sources: Westerhof et al. 2009 (windkessel);
/// Regazzoni et al. 2022 (closed loop, values).
struct TwoSidedLoop {
  struct Side {
    Valve inlet, outlet;
    Windkessel arteries;                       ///< of this ventricle; its reference pressure plays no part
    double venous_compliance_mm3_per_kPa = 0;  ///< of the veins and the atrium before this ventricle
  };
  Side left, right;
};

/// Indices of the states.
enum TwoSidedIndex {
  left_volume,
  right_volume,
  systemic_arterial_pressure,
  pulmonary_arterial_pressure,
  pulmonary_venous_pressure,  ///< before the left ventricle
  systemic_venous_pressure,   ///< before the right ventricle
  two_sided_size
};

class TwoSidedCirculation : public CirculationModel {
 public:
  explicit TwoSidedCirculation(const TwoSidedLoop& loop) : loop_(loop) {}
  int num_cavities() const override { return 2; }
  int num_states() const override { return two_sided_size; }
  Rates rates(double time_ms, const polyaffine::Vector& states,
              const polyaffine::Vector& pressures_kPa) const override;
  Side side(int cavity, double time_ms, const polyaffine::Vector& states,
            const polyaffine::Vector& pressures_kPa) const override;
  const Valve& inlet(int cavity) const override { return of(cavity).inlet; }
  const Valve& outlet_valve(int cavity) const override { return of(cavity).outlet; }
  polyaffine::Vector compliances() const override;
  bool is_closed() const override { return true; }
  double slowest_ms() const override;

  /// Σ V + Σ C p in mm³.
  double blood_volume(const polyaffine::Vector& states) const;

 private:
  const TwoSidedLoop::Side& of(int cavity) const { return cavity == 0 ? loop_.left : loop_.right; }

  TwoSidedLoop loop_;
};

}  // namespace cardiac
