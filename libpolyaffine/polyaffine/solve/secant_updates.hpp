#pragma once

#include <vector>

#include <polyaffine/core/types.hpp>

namespace polyaffine {

/// Broyden's good updates of an inverse tangent H₀ that is used longer than it is exact,
///   H_k = (I + u_k v_kᵀ) … (I + u_1 v_1ᵀ) H₀,
/// learnt from the steps s = H r of Newton iterations on a residual r: with the next residual r₊ and w = H
/// r₊, v = D²s and u = w / vᵀ(s − w), D being weights of the unknowns (Broyden 1965; Kelley 1995, §7.3). They
/// cost two products a pair and stay from one time step to the next.
class SecantUpdates {
 public:
  /// Forgets all: H₀ is new.
  void clear();
  /// The next residual is not that after the last step (a new time step).
  void restart() { step_.resize(0); }
  /// From H₀ r to the step H r. `weights` (D) as long as x.
  void improve(const Eigen::Ref<const Vector>& weights, Vector& x);

 private:
  struct Pair {
    Vector u, v;
  };
  std::vector<Pair> pairs_;
  Vector step_;
};

}  // namespace polyaffine
