#pragma once

#include <polyaffine/core/types.hpp>
#include <string>
#include <vector>

#include <cardiac/circulation/left_heart_loop.hpp>

namespace cardiac {

/// What the cavities of a heart are coupled to: states z, the first of them the volumes of the cavities
/// (mm³), then pressures of vessels (kPa), volumes of chambers (mm³) and flows (mm³/ms), that obey
/// ż = f(t, z, p) under the cavity pressures p (kPa; left, right). What depends on the time (ms) repeats with
/// the heart period.
class CirculationModel {
 public:
  virtual ~CirculationModel() = default;
  virtual int num_cavities() const = 0;
  virtual int num_states() const = 0;
  /// What states are, by kind in this order; the volumes of the cavities go before them.
  struct Kinds {
    int pressures = 0, volumes = 0, flows = 0;
  };
  virtual Kinds kinds() const { return {num_states() - num_cavities(), 0, 0}; }

  struct Rates {
    polyaffine::Vector values;        ///< f, a unit of the states per ms
    polyaffine::Matrix by_states;     ///< ∂f/∂z
    polyaffine::Matrix by_pressures;  ///< ∂f/∂p
  };
  virtual Rates rates(double time_ms, const polyaffine::Vector& states,
                      const polyaffine::Vector& pressures_kPa) const = 0;

  /// Pressures in kPa and flows in mm³/ms about one cavity.
  struct Side {
    double before_kPa;         ///< before the inlet valve: veins and atrium
    double capacitor_kPa;      ///< of the arteries' compliance: what the outlet (valve and Z) ejects against
    double artery_kPa;         ///< behind the outlet valve: capacitor pressure + Z · outflow
    double behind_kPa;         ///< behind the small vessels: the veins
    double inflow_mm3_per_ms;  ///< of all that comes in, through the inlet valve; backwards: negative
    double outflow_mm3_per_ms;
    double run_off_mm3_per_ms;  ///< through the small vessels
    double inlet_mm3_per_ms;    ///< through the inlet valve alone
    double outlet_mm3_per_ms;
  };
  virtual Side side(int cavity, double time_ms, const polyaffine::Vector& states,
                    const polyaffine::Vector& pressures_kPa) const = 0;
  /// What the parts of a side are called.
  struct Names {
    std::string before, ventricle, artery, arteries, inlet, outlet, vessels;
  };
  virtual Names names(int cavity) const;
  /// The valves about a cavity.
  virtual const Valve& inlet(int cavity) const = 0;
  virtual const Valve& outlet_valve(int cavity) const = 0;
  /// Compliance of each state that is a pressure, mm³/kPa, zero for the volumes; in a closed loop the sum of
  /// the volumes and of compliance · pressure never changes.
  virtual polyaffine::Vector compliances() const = 0;
  virtual bool is_closed() const = 0;  ///< whether blood comes back
  /// The longest time constant of a vessel that empties through what it is connected to, ms.
  virtual double slowest_ms() const = 0;

  /// All that the circulation has a name for: pressures in kPa, flows in mm³/ms, volumes in mm³.
  enum class Quantity { pressure, flow, volume };
  struct Reading {
    std::string name;
    Quantity quantity;
    double value;
  };
  virtual std::vector<Reading> readings(double time_ms, const polyaffine::Vector& states,
                                        const polyaffine::Vector& pressures_kPa) const;
  /// What flows into and out of each compliance, mm³/ms.
  struct Balance {
    std::string name;
    double inflow_mm3_per_ms, outflow_mm3_per_ms;
  };
  virtual std::vector<Balance> balances(double time_ms, const polyaffine::Vector& states,
                                        const polyaffine::Vector& pressures_kPa) const;
};

/// The loop of one left ventricle; states V and p_c.
class LeftHeartCirculation : public CirculationModel {
 public:
  explicit LeftHeartCirculation(const LeftHeartLoop& loop) : loop_(loop) {}
  int num_cavities() const override { return 1; }
  int num_states() const override { return 2; }
  Rates rates(double time_ms, const polyaffine::Vector& states,
              const polyaffine::Vector& pressures_kPa) const override;
  Side side(int cavity, double time_ms, const polyaffine::Vector& states,
            const polyaffine::Vector& pressures_kPa) const override;
  const Valve& inlet(int) const override { return loop_.mitral; }
  const Valve& outlet_valve(int) const override { return loop_.aortic; }
  polyaffine::Vector compliances() const override;
  bool is_closed() const override { return false; }
  double slowest_ms() const override;

 private:
  LeftHeartLoop loop_;
};

}  // namespace cardiac
