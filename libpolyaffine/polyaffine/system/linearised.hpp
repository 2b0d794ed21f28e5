#pragma once

#include <polyaffine/system/system.hpp>

namespace polyaffine {

/// Calls of a system and the seconds spent in them.
struct SystemCost {
  long residuals = 0, factorisations = 0, linear_solves = 0;
  double residual_s = 0, tangent_s = 0, factorisation_s = 0, linear_solve_s = 0;
  SystemCost& operator+=(const SystemCost& more);
};

/// A system's tangent ∂R/∂y + α ∂R/∂ẏ at a state, factorised, and Newton's corrections with it. Unknowns that
/// terms solve apart are eliminated by them; with the few others s the rest reads
///   K δc + B δs = ρ_c,  C δc + D δs + [L(s + δs, ṡ + α δs) − L(s, ṡ)] = ρ_s,
/// L being the terms that are met exactly: δc = K⁻¹(ρ_c − B δs) leaves equations for the few unknowns alone,
/// solved by Newton's method on L to 1e-10.
class Linearised {
 public:
  /// Both must outlive it. The linear system holds K and its factors, and may be used for the next tangent.
  Linearised(const System& system, LinearSystem& linear) : system_(system), linear_(linear) {}

  /// False when the tangent is singular.
  bool factorise(const At& at, double alpha);
  bool positive_definite() const { return linear_.positive_definite(); }
  /// Newton's correction from the state `at`, whose residual is −rhs. False when it is not finite.
  bool solve(const At& at, const Vector& rhs, Vector& step);

  /// K⁻¹ ∂R_field/∂s of one of the few unknowns: how the field answers to it.
  Vector response(int unknown) const;
  /// ∂R_s/∂c of one of the few unknowns.
  Vector row(int unknown) const;

  const SystemCost& cost() const { return cost_; }

 private:
  Vector solve_few(const At& at, const Vector& rhs, const Vector& field) const;

  const System& system_;
  LinearSystem& linear_;
  double alpha_ = 0;
  std::vector<std::unique_ptr<const Elimination>> eliminations_;
  std::vector<Tangent::Line> columns_, rows_;
  std::vector<Vector> responses_;  // K⁻¹ of the columns
  Matrix corner_, few_;            // D, and with the field eliminated D − C K⁻¹ B
  SystemCost cost_;
};

}  // namespace polyaffine
