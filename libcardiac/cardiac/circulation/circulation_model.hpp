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
};

/// The loop of one left ventricle; states V and p_c.
class LeftHeartCirculation : public CirculationModel {
 public:
  explicit LeftHeartCirculation(const LeftHeartLoop& loop) : loop_(loop) {}
  int num_cavities() const override { return 1; }
  int num_states() const override { return 2; }
  Rates rates(const polyaffine::Vector& states, const polyaffine::Vector& pressures_kPa) const override;

 private:
  LeftHeartLoop loop_;
};

}  // namespace cardiac
