#include "cardiac/model/beat_system.hpp"

#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <limits>

#include <cardiac/core/units.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

constexpr int kMaxLoopIterations = 30;
constexpr double kLoopTolerance = 1e-10;

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

BeatSystem::BeatSystem(const Ventricle& ventricle, std::shared_ptr<const CirculationModel> circulation)
    : ventricle_(ventricle),
      circulation_(std::move(circulation)),
      cavities_(ventricle.cavities()),
      num_c_(ventricle.num_coefficients()),
      num_cavities_(circulation_->num_cavities()),
      num_states_(circulation_->num_states()),
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
  const Vector p = pressures(y);
  const Vector& tau = tension(t);
  const auto wall =
      ventricle_.wall->evaluate({c, {tau.data(), static_cast<std::size_t>(tau.size())}, &c_rate});
  if (!(wall.min_det > 0)) return false;
  min_det_ = wall.min_det;
  max_det_ = wall.max_det;
  out.resize(size());
  out.head(num_c_) = wall.gradient;
  for (int k = 0; k < num_cavities_; ++k) {
    const auto cavity = cavities_[k]->evaluate({c});
    out.head(num_c_) -= p[k] * cavity.gradient;
    out[num_c_ + k] = y[num_c_ + k] - cavity.value;
  }
  for (const auto& spring : ventricle_.springs) out.head(num_c_) += spring->evaluate({c}).gradient;
  const auto& fixed = ventricle_.discretisation.fixed;
  for (int i = 0; i < num_c_; ++i)
    if (fixed[i]) out[i] = c[i];
  circulating_states_ = states(y);
  circulating_pressures_ = p;
  circulating_ = circulation_->rates(circulating_states_, p);
  out.tail(num_states_) = states(rate) - circulating_.values;
  return true;
}

bool BeatSystem::factorise(double t, const Vector& y, const Vector& rate, double alpha) {
  const Vector c = y.head(num_c_);
  const Vector c_rate = rate.head(num_c_);
  const Vector p = pressures(y);
  ++cost_.factorisations;
  {
    const Stopwatch watch(cost_.tangent_s);
    const Vector& tau = tension(t);
    system_->set_zero();
    ventricle_.wall->add_tangent({c, {tau.data(), static_cast<std::size_t>(tau.size())}, &c_rate}, *system_,
                                 1, alpha);
    for (int k = 0; k < num_cavities_; ++k) cavities_[k]->add_tangent({c}, *system_, -p[k]);
    for (const auto& spring : ventricle_.springs) spring->add_tangent({c}, *system_);
  }
  const Stopwatch watch(cost_.factorisation_s);
  if (!system_->factorise()) return false;
  const auto& fixed = ventricle_.discretisation.fixed;
  volume_gradient_.resize(num_c_, num_cavities_);
  solved_gradient_.resize(num_c_, num_cavities_);
  for (int k = 0; k < num_cavities_; ++k) {
    volume_gradient_.col(k) = cavities_[k]->evaluate({c}).gradient;
    for (int i = 0; i < num_c_; ++i)
      if (fixed[i]) volume_gradient_(i, k) = 0;
    solved_gradient_.col(k) = system_->solve(volume_gradient_.col(k));
  }
  alpha_ = alpha;
  return true;
}

// Rows, with s = [V, z]: K δc − g δp = r_c,  δV − gᵀδc = r_V,  α δs − f(s + δs, p + δp) + f(s, p) = r_s.
// The wall is linearised; the circulation's few equations, which stiff valves bend sharply, are met as they
// are.
bool BeatSystem::solve(const Vector& rhs, Vector& x) {
  const Stopwatch watch(cost_.linear_solve_s);
  ++cost_.linear_solves;
  const int n = num_states_, m = num_cavities_;
  const Vector w = system_->solve(rhs.head(num_c_));
  polyaffine::Matrix A = polyaffine::Matrix::Zero(n + m, n + m);
  A.bottomLeftCorner(m, m).setIdentity();
  A.bottomRightCorner(m, m) = -volume_gradient_.transpose() * solved_gradient_;
  Vector b(n + m);
  b << rhs.tail(n) - circulating_.values, rhs.segment(num_c_, m) + volume_gradient_.transpose() * w;
  CirculationModel::Rates flows = circulating_;
  Vector loop = Vector::Zero(n + m), miss = b;
  for (int k = 0; k < kMaxLoopIterations; ++k) {
    A.topLeftCorner(n, n) = -flows.by_states;
    A.topLeftCorner(n, n).diagonal().array() += alpha_;
    A.topRightCorner(n, m) = -flows.by_pressures;
    miss << b.head(n) - alpha_ * loop.head(n) + flows.values, b.tail(m) - A.bottomRows(m) * loop;
    const Vector step = A.partialPivLu().solve(miss);
    loop += step;
    if (step.norm() <= kLoopTolerance * loop.norm()) break;
    flows = circulation_->rates(circulating_states_ + loop.head(n), circulating_pressures_ + loop.tail(m));
  }
  x.resize(size());
  x << w + solved_gradient_ * loop.tail(m), loop.head(m), loop.tail(m), loop.segment(m, n - m);
  return x.allFinite();
}

Vector BeatSystem::states(const Vector& y) const {
  Vector out(num_states_);
  out << y.segment(num_c_, num_cavities_), y.tail(num_states_ - num_cavities_);
  return out;
}

Vector BeatSystem::pack(const HeartState& state) const {
  Vector y(size());
  if (num_cavities_ == 1)
    y << state.c, state.volume_mm3, state.pressure_kPa, state.capacitor_pressure_kPa;
  else
    y << state.c, state.volume_mm3, state.right_volume_mm3, state.pressure_kPa, state.right_pressure_kPa,
        state.capacitor_pressure_kPa, state.loop;
  return y;
}

HeartState BeatSystem::unpack(double t, double beat_start_ms, const Vector& y) const {
  const int m = num_cavities_;
  HeartState out{t - beat_start_ms, y.head(num_c_), y[num_c_], y[num_c_ + m], y[num_c_ + 2 * m]};
  if (m == 1) return out;
  out.right_volume_mm3 = y[num_c_ + 1];
  out.right_pressure_kPa = y[num_c_ + 3];
  out.loop = y.tail(num_states_ - m - 1);
  return out;
}

Vector BeatSystem::start_consistently(HeartState& state) {
  Vector y = pack(state);
  Vector rate = Vector::Zero(size());
  restart_consistently(state.time_ms, y, rate);
  state = unpack(state.time_ms, 0, y);
  return rate;
}

void BeatSystem::restart_consistently(double t, Vector& y, Vector& rate) {
  const int m = num_cavities_;
  const auto circulate = [&] { return circulation_->rates(states(y), pressures(y)); };
  rate.tail(num_states_ - m) = circulate().values.tail(num_states_ - m);
  // So large that the elastic part of K + αC does not count.
  constexpr double kAlpha = 1e8;
  if (!factorise(t, y, rate, kAlpha)) return;
  const polyaffine::Matrix Z = kAlpha * solved_gradient_;
  const polyaffine::Matrix compliance = volume_gradient_.transpose() * Z;
  const Vector moving = rate.segment(num_c_, m);
  Vector delta = Vector::Zero(m);
  for (int k = 0; k < 50; ++k) {
    const auto flows = circulate();
    const Vector step = (compliance - flows.by_pressures.topRows(m))
                            .partialPivLu()
                            .solve(Vector(compliance * delta + moving - flows.values.head(m)));
    delta -= step;
    y.segment(num_c_ + m, m) -= step;
    if (step.norm() <= 1e-14 * y.segment(num_c_ + m, m).norm()) break;
  }
  rate.head(num_c_) += Z * delta;
  rate.segment(num_c_, m) += compliance * delta;
  rate.tail(num_states_ - m) = circulate().values.tail(num_states_ - m);
}

polyaffine::DaeOptions BeatSystem::options(const protocol::Time& time) const {
  polyaffine::DaeOptions out;
  out.relative_tolerance = time.relative_tolerance;
  out.absolute_tolerance = Vector::Constant(size(), time.absolute_tolerance_mm);
  const int others = size() - num_c_;
  out.absolute_tolerance.segment(num_c_, num_cavities_).setConstant(0.01 * mm3_per_mL);
  out.absolute_tolerance.tail(others - num_cavities_)
      .setConstant(time.absolute_tolerance_mmHg * kPa_per_mmHg);
  out.error_weight = Vector::Ones(size());
  out.error_weight.tail(others).setConstant(std::sqrt(num_c_ / static_cast<double>(others)));
  // While its valves are closed, the pressure of a cavity is the multiplier of its constant volume.
  out.error_tested = Vector::Ones(size());
  out.error_tested.segment(num_c_ + num_cavities_, num_cavities_).setZero();
  out.max_step = time.max_step_ms;
  return out;
}

}  // namespace cardiac
