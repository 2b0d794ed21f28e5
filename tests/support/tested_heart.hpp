#pragma once

#include <cardiac/model/coupled_heart.hpp>
#include <cardiac/protocol/protocol.hpp>

namespace cardiac::testing {

/// A coupled heart with a tangent of its own, as time integration uses it.
class TestedHeart {
 public:
  TestedHeart(const Ventricle& ventricle, std::shared_ptr<const CirculationModel> circulation)
      : heart(couple(ventricle, std::move(circulation), protocol::Time{})),
        linear_(heart.system.make_linear()),
        linearised_(heart.system, *linear_) {}

  int size() const { return heart.system.size(); }
  /// False where the state is not admissible.
  bool residual(double t, const polyaffine::Vector& y, const polyaffine::Vector& rate,
                polyaffine::Vector& out) const {
    polyaffine::Residual r = heart.system.residual({t, y, &rate});
    out = std::move(r.values);
    return r.min_det > 0;
  }
  bool factorise(double t, const polyaffine::Vector& y, const polyaffine::Vector& rate, double alpha) {
    return linearised_.factorise({t, y, &rate}, alpha);
  }
  bool solve(double t, const polyaffine::Vector& y, const polyaffine::Vector& rate,
             const polyaffine::Vector& rhs, polyaffine::Vector& x) {
    return linearised_.solve({t, y, &rate}, rhs, x);
  }

  CoupledHeart heart;

 private:
  std::unique_ptr<polyaffine::LinearSystem> linear_;
  polyaffine::Linearised linearised_;
};

}  // namespace cardiac::testing
