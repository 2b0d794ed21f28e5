#include "polyaffine/system/inertia.hpp"

#include <utility>

#include <polyaffine/material/springs.hpp>

namespace polyaffine {

// ½ ρ |v|² has the form of a spring's energy.
Inertia::Inertia(FieldTable body, double density, double velocity_tolerance, StateLayout& layout)
    : mass_(std::move(body), {std::make_shared<SurfaceSpring>(density)}),
      density_(density),
      c_{0, mass_.table().num_unknowns()},
      v_(layout.add({.name = "velocity",
                     .unit = "mm/ms",
                     .solved = Solved::apart,
                     .absolute_tolerance = velocity_tolerance,
                     .error_tested = false},
                    c_.size)) {}

void Inertia::add_residual(const At& at, Residual& out) const {
  const Vector force = momentum(at.rate_of(v_));
  c_.of(out.values) += force;
  out.forces += force.norm();
  v_.of(out.values) += at.rate_of(c_) - v_.of(at.y);
}

class Inertia::EliminatedVelocity : public Elimination {
 public:
  EliminatedVelocity(const Inertia& of, double alpha) : of_(of), alpha_(alpha) {}
  void condense(const Vector& rhs, Eigen::Ref<Vector> field) const override {
    field += alpha_ * of_.momentum(of_.v_.of(rhs));
  }
  void recover(const Vector& rhs, Vector& step) const override {
    of_.v_.of(step) = alpha_ * of_.c_.of(step) - of_.v_.of(rhs);
  }

 private:
  const Inertia& of_;
  double alpha_;
};

void Inertia::add_tangent(const At& at, double alpha, Tangent& out) const {
  mass_.add_tangent({v_.of(at.y)}, out.field, alpha * alpha);
  out.eliminations.push_back(std::make_unique<EliminatedVelocity>(*this, alpha));
}

double Inertia::stored_energy(const At& at) const {
  return at.rate ? mass_.evaluate({c_.of(*at.rate)}).value : 0;
}

void Inertia::add_parameter_derivative(const std::string& parameter, const At& at, Vector& out) const {
  if (parameter != "density") return Term::add_parameter_derivative(parameter, at, out);
  c_.of(out) += momentum(at.rate_of(v_)) / density_;
}

void Inertia::add_tables(std::vector<const FieldTable*>& out) const {
  out.push_back(&mass_.table());
}

}  // namespace polyaffine
