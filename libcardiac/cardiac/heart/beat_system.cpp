#include "cardiac/heart/beat_system.hpp"

#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <limits>

#include <cardiac/core/units.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

// Adds the seconds of its life to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum_s) : sum_s_(sum_s) {}
  ~Stopwatch() { sum_s_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& sum_s_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

BeatSystem::BeatSystem(const Ventricle& ventricle, const LeftHeartLoop& loop)
    : ventricle_(ventricle),
      loop_(loop),
      num_c_(ventricle.num_coefficients()),
      system_(ventricle.make_system()),
      tension_time_(std::numeric_limits<double>::quiet_NaN()) {}

const Vector& BeatSystem::tension(double t) {
  if (t != tension_time_) {
    tension_ = ventricle_.contraction->tension(t);
    tension_time_ = t;
  }
  return tension_;
}

bool BeatSystem::residual(double t, const Vector& y, const Vector& rate, Vector& out) {
  const Stopwatch watch(cost_.residual_s);
  ++cost_.residuals;
  const Vector c = y.head(num_c_);
  const Vector c_rate = rate.head(num_c_);
  const double p = y[num_c_ + 1];
  const Vector& tau = tension(t);
  const auto wall =
      ventricle_.wall->evaluate({c, {tau.data(), static_cast<std::size_t>(tau.size())}, &c_rate});
  if (!(wall.min_det > 0)) return false;
  min_det_ = wall.min_det;
  max_det_ = wall.max_det;
  const auto cavity = ventricle_.cavity->evaluate({c});
  out.resize(size());
  out.head(num_c_) = wall.gradient - p * cavity.gradient;
  for (const auto& spring : ventricle_.springs) out.head(num_c_) += spring->evaluate({c}).gradient;
  const auto& fixed = ventricle_.discretisation.fixed;
  for (int i = 0; i < num_c_; ++i)
    if (fixed[i]) out[i] = c[i];
  loop_state_ = loop_residual(loop_, rate[num_c_], p, y[num_c_ + 2], rate[num_c_ + 2]);
  out[num_c_] = y[num_c_] - cavity.value;
  out[num_c_ + 1] = loop_state_.volume;
  out[num_c_ + 2] = loop_state_.capacitor;
  return true;
}

bool BeatSystem::factorise(double t, const Vector& y, const Vector& rate, double alpha) {
  const Vector c = y.head(num_c_);
  const Vector c_rate = rate.head(num_c_);
  const double p = y[num_c_ + 1];
  ++cost_.factorisations;
  {
    const Stopwatch watch(cost_.tangent_s);
    const Vector& tau = tension(t);
    system_->set_zero();
    ventricle_.wall->add_tangent({c, {tau.data(), static_cast<std::size_t>(tau.size())}, &c_rate}, *system_,
                                 1, alpha);
    ventricle_.cavity->add_tangent({c}, *system_, -p);
    for (const auto& spring : ventricle_.springs) spring->add_tangent({c}, *system_);
  }
  const Stopwatch watch(cost_.factorisation_s);
  if (!system_->factorise()) return false;
  volume_gradient_ = ventricle_.cavity->evaluate({c}).gradient;
  const auto& fixed = ventricle_.discretisation.fixed;
  for (int i = 0; i < num_c_; ++i)
    if (fixed[i]) volume_gradient_[i] = 0;
  solved_gradient_ = system_->solve(volume_gradient_);
  loop_state_ = loop_residual(loop_, rate[num_c_], p, y[num_c_ + 2], rate[num_c_ + 2]);
  alpha_ = alpha;
  return true;
}

// Rows: K δc − g δp = r_c,  δV − gᵀδc = r_V,  α δV + a δp + b δp_c = r_q,  d δp + e δp_c = r_w.
bool BeatSystem::solve(const Vector& rhs, Vector& x) {
  const Stopwatch watch(cost_.linear_solve_s);
  ++cost_.linear_solves;
  const Vector w = system_->solve(rhs.head(num_c_));
  const double base_volume = rhs[num_c_] + volume_gradient_.dot(w);
  const double compliance = volume_gradient_.dot(solved_gradient_);
  Eigen::Matrix2d A;
  A << alpha_ * compliance + loop_state_.volume_by_pressure, loop_state_.volume_by_capacitor_pressure,
      loop_state_.capacitor_by_pressure,
      loop_state_.capacitor_by_capacitor_pressure + alpha_ * loop_state_.capacitor_by_capacitor_rate;
  const Eigen::Vector2d pressures =
      A.partialPivLu().solve(Eigen::Vector2d(rhs[num_c_ + 1] - alpha_ * base_volume, rhs[num_c_ + 2]));
  x.resize(size());
  x.head(num_c_) = w + pressures[0] * solved_gradient_;
  x[num_c_] = base_volume + compliance * pressures[0];
  x.tail<2>() = pressures;
  return x.allFinite();
}

Vector BeatSystem::pack(const HeartState& state) const {
  Vector y(size());
  y << state.c, state.volume_mm3, state.pressure_kPa, state.capacitor_pressure_kPa;
  return y;
}

HeartState BeatSystem::unpack(double t, double beat_start_ms, const Vector& y) const {
  return {t - beat_start_ms, y.head(num_c_), y[num_c_], y[num_c_ + 1], y[num_c_ + 2]};
}

Vector BeatSystem::start_consistently(HeartState& state) {
  Vector rate = Vector::Zero(size());
  const double p_c = state.capacitor_pressure_kPa;
  rate[num_c_ + 2] = loop_rates(loop_, state.pressure_kPa, p_c).capacitor_pressure_kPa_per_ms;
  // So large that the elastic part of K + αC does not count.
  constexpr double kAlpha = 1e8;
  if (!factorise(state.time_ms, pack(state), rate, kAlpha)) return rate;
  const Vector z = kAlpha * solved_gradient_;
  const double compliance = z.dot(volume_gradient_);
  double delta = 0;
  for (int k = 0; k < 50; ++k) {
    const LoopResidual loop =
        loop_residual(loop_, compliance * delta, state.pressure_kPa + delta, p_c, rate[num_c_ + 2]);
    const double step = loop.volume / (compliance + loop.volume_by_pressure);
    delta -= step;
    if (std::abs(step) <= 1e-14 * state.pressure_kPa) break;
  }
  state.pressure_kPa += delta;
  rate.head(num_c_) = delta * z;
  rate[num_c_] = compliance * delta;
  rate[num_c_ + 2] = loop_rates(loop_, state.pressure_kPa, p_c).capacitor_pressure_kPa_per_ms;
  return rate;
}

polyaffine::DaeOptions BeatSystem::options(const protocol::Time& time) const {
  polyaffine::DaeOptions out;
  out.relative_tolerance = time.relative_tolerance;
  out.absolute_tolerance = Vector::Constant(size(), time.absolute_tolerance_mm);
  out.absolute_tolerance[num_c_] = 0.01 * mm3_per_mL;
  out.absolute_tolerance.tail<2>().setConstant(time.absolute_tolerance_mmHg * kPa_per_mmHg);
  out.error_weight = Vector::Ones(size());
  out.error_weight.tail<3>().setConstant(std::sqrt(num_c_ / 3.0));
  out.max_step = time.max_step_ms;
  return out;
}

}  // namespace cardiac
