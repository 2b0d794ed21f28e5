#pragma once

#include <utility>

#include <cardiac/circulation/circulation_model.hpp>
#include <cardiac/core/given_curve.hpp>

namespace cardiac {

/// Whatever flows into and out of cavities whose volumes are given: V̇ = ġ(t) + (g(t) − V)/τ with τ = 1 ms, so
/// that a volume follows its curve g and comes back to it from an error of rounding. The pressures are those
/// that it takes. No vessels.
class GivenVolumes : public CirculationModel {
 public:
  explicit GivenVolumes(std::vector<GivenCurve> curves) : curves_(std::move(curves)) {}
  int num_cavities() const override { return static_cast<int>(curves_.size()); }
  int num_states() const override { return num_cavities(); }
  Rates rates(double time_ms, const polyaffine::Vector& states,
              const polyaffine::Vector& pressures_kPa) const override;
  /// Flow into the cavity or out of it; there is nothing else about it.
  Side side(int cavity, double time_ms, const polyaffine::Vector& states,
            const polyaffine::Vector& pressures_kPa) const override;
  const Valve& inlet(int) const override { return none_; }
  const Valve& outlet_valve(int) const override { return none_; }
  polyaffine::Vector compliances() const override { return polyaffine::Vector::Zero(num_states()); }
  bool is_closed() const override { return false; }
  double slowest_ms() const override { return 0; }

 private:
  std::vector<GivenCurve> curves_;
  Valve none_;
};

}  // namespace cardiac
