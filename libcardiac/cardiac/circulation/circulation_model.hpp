#pragma once

#include <polyaffine/core/types.hpp>

#include <cardiac/circulation/left_heart_loop.hpp>

namespace cardiac {

/// What the cavities of a heart are coupled to: states z, the first of them the volumes of the cavities
/// (mm³), then pressures (kPa), that obey ż = f(z, p) under the cavity pressures p (kPa; left, right).
class CirculationModel {
 public:
  virtual ~CirculationModel() = default;
  virtual int num_cavities() const = 0;
  virtual int num_states() const = 0;

  struct Rates {
    polyaffine::Vector values;        ///< f, a unit of the states per ms
    polyaffine::Matrix by_states;     ///< ∂f/∂z
    polyaffine::Matrix by_pressures;  ///< ∂f/∂p
  };
  virtual Rates rates(const polyaffine::Vector& states, const polyaffine::Vector& pressures_kPa) const = 0;

  /// Pressures in kPa and flows in mm³/ms about one cavity.
  struct Side {
    double before_kPa;         ///< before the inlet valve: veins and atrium
    double capacitor_kPa;      ///< of the arteries' compliance: what the outlet (valve and Z) ejects against
    double artery_kPa;         ///< behind the outlet valve: capacitor pressure + Z · outflow
    double behind_kPa;         ///< behind the small vessels: the veins
    double inflow_mm3_per_ms;  ///< through the inlet valve; backwards: negative
    double outflow_mm3_per_ms;
    double run_off_mm3_per_ms;  ///< through the small vessels
  };
  virtual Side side(int cavity, const polyaffine::Vector& states,
                    const polyaffine::Vector& pressures_kPa) const = 0;
  /// The valves about a cavity.
  virtual const Valve& inlet(int cavity) const = 0;
  virtual const Valve& outlet_valve(int cavity) const = 0;
  /// Compliance of each state that is a pressure, mm³/kPa, zero for the volumes; in a closed loop the sum of
  /// the volumes and of compliance · pressure never changes.
  virtual polyaffine::Vector compliances() const = 0;
  virtual bool is_closed() const = 0;  ///< whether blood comes back
};

/// The loop of one left ventricle; states V and p_c.
class LeftHeartCirculation : public CirculationModel {
 public:
  explicit LeftHeartCirculation(const LeftHeartLoop& loop) : loop_(loop) {}
  int num_cavities() const override { return 1; }
  int num_states() const override { return 2; }
  Rates rates(const polyaffine::Vector& states, const polyaffine::Vector& pressures_kPa) const override;
  Side side(int cavity, const polyaffine::Vector& states,
            const polyaffine::Vector& pressures_kPa) const override;
  const Valve& inlet(int) const override { return loop_.mitral; }
  const Valve& outlet_valve(int) const override { return loop_.aortic; }
  polyaffine::Vector compliances() const override;
  bool is_closed() const override { return false; }

 private:
  LeftHeartLoop loop_;
};

}  // namespace cardiac
