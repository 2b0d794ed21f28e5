#pragma once

#include <array>
#include <memory>

#include <cardiac/model/ventricle.hpp>
#include <polyaffine/solve/dae.hpp>

namespace cardiac {

/// A contracting wall under constant cavity pressures (left, right; kPa) as an implicit system over its
/// coefficients c: ∂W/∂c(c, ċ, τ(t)) − Σ p ∂V/∂c + springs = 0, viscosity in W.
class PressedWall : public polyaffine::DaeSystem {
 public:
  PressedWall(const Ventricle& ventricle, const std::array<double, 2>& pressures_kPa);

  int size() const override { return ventricle_.num_coefficients(); }
  bool residual(double t, const polyaffine::Vector& c, const polyaffine::Vector& rate,
                polyaffine::Vector& out) override;
  bool factorise(double t, const polyaffine::Vector& c, const polyaffine::Vector& rate,
                 double alpha) override;
  bool solve(const polyaffine::Vector& rhs, polyaffine::Vector& x) override;

  polyaffine::DaeOptions options(const protocol::Time& time) const;
  /// Range of det F in the state evaluated last.
  double min_det() const { return min_det_; }
  double max_det() const { return max_det_; }

 private:
  const Ventricle& ventricle_;
  std::vector<const polyaffine::FieldEnergy*> cavities_;
  std::array<double, 2> pressures_kPa_;
  std::unique_ptr<polyaffine::LinearSystem> system_;
  double min_det_ = 1, max_det_ = 1;
};

}  // namespace cardiac
