#include "cardiac/model/pressed_wall.hpp"

namespace cardiac {

using polyaffine::PointState;
using polyaffine::Vector;

PressedWall::PressedWall(const Ventricle& ventricle, const std::array<double, 2>& pressures_kPa)
    : ventricle_(ventricle),
      cavities_(ventricle.cavities()),
      pressures_kPa_(pressures_kPa),
      system_(ventricle.make_system()) {}

bool PressedWall::residual(double t, const Vector& c, const Vector& rate, Vector& out) {
  const Vector tau = ventricle_.contraction->tension(t);
  const auto wall =
      ventricle_.wall->evaluate({c, PointState(tau.data(), static_cast<std::size_t>(tau.size())), &rate});
  if (!(wall.min_det > 0)) return false;
  min_det_ = wall.min_det;
  max_det_ = wall.max_det;
  out = wall.gradient;
  for (std::size_t k = 0; k < cavities_.size(); ++k)
    out -= pressures_kPa_[k] * cavities_[k]->evaluate({c}).gradient;
  for (const auto& spring : ventricle_.springs) out += spring->evaluate({c}).gradient;
  const auto& fixed = ventricle_.discretisation.fixed;
  for (Eigen::Index i = 0; i < c.size(); ++i)
    if (fixed[static_cast<std::size_t>(i)]) out[i] = c[i];
  return true;
}

bool PressedWall::factorise(double t, const Vector& c, const Vector& rate, double alpha) {
  const Vector tau = ventricle_.contraction->tension(t);
  system_->set_zero();
  ventricle_.wall->add_tangent({c, PointState(tau.data(), static_cast<std::size_t>(tau.size())), &rate},
                               *system_, 1, alpha);
  for (std::size_t k = 0; k < cavities_.size(); ++k)
    cavities_[k]->add_tangent({c}, *system_, -pressures_kPa_[k]);
  for (const auto& spring : ventricle_.springs) spring->add_tangent({c}, *system_);
  return system_->factorise();
}

bool PressedWall::solve(const Vector& rhs, Vector& x) {
  x = system_->solve(rhs);
  return x.allFinite();
}

polyaffine::DaeOptions PressedWall::options(const protocol::Time& time) const {
  polyaffine::DaeOptions out;
  out.relative_tolerance = time.relative_tolerance;
  out.absolute_tolerance = Vector::Constant(size(), time.absolute_tolerance_mm);
  out.max_step = time.max_step_ms;
  return out;
}

}  // namespace cardiac
