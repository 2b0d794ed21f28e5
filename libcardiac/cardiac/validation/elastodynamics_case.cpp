#include "cardiac/validation/elastodynamics_case.hpp"

#include <algorithm>
#include <cmath>

#include <polyaffine/core/error.hpp>
#include <polyaffine/solve/ode.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

constexpr double kWidth_ms = 5, kPreload_ms = 170, kEnd_ms = 484;
constexpr double kAlphaMax = 0.005, kAlphaMin = -0.030, kAlphaPre = 0.005;  // 1/ms
constexpr double kStep_ms = 0.5;

double rising(double time_ms) {
  return 0.5 * (1 + std::tanh(time_ms / kWidth_ms));
}

}  // namespace

double pressure_rate(const BenchmarkPressure& pressure, double t, double p) {
  const double g = rising(kEnd_ms - t), f = rising(t - kPreload_ms) * g;
  const double b = kAlphaMax * f + kAlphaMin * (1 - f) + kAlphaPre * g + 1e-3 * pressure.alpha_mid_per_s;
  // σ_pre max(g, 0) is a rate in 1/s times a stress.
  return -std::abs(b) * p + pressure.sigma_mid_kPa * std::max(b, 0.0) + 1e-3 * pressure.sigma_pre_kPa * g;
}

BenchmarkPressureCurve::BenchmarkPressureCurve(const BenchmarkPressure& pressure, double end_ms)
    : step_ms_(kStep_ms) {
  const auto n = static_cast<Eigen::Index>(std::ceil(end_ms / step_ms_)) + 1;
  const Vector times = Vector::LinSpaced(n, 0, step_ms_ * static_cast<double>(n - 1));
  const auto rate = [&](double t, const Vector& p, Vector& out) {
    out[0] = pressure_rate(pressure, t, p[0]);
  };
  const auto solution =
      polyaffine::solve_ode(rate, 0, Vector::Zero(1), times,
                            {.relative_tolerance = 1e-8, .absolute_tolerance = 1e-9, .max_step = kWidth_ms});
  if (!solution.finished()) throw polyaffine::ComputationError("benchmark pressure: " + solution.message);
  values_ = solution.states.row(0).transpose();
}

double BenchmarkPressureCurve::at(double time_ms) const {
  const double place = std::clamp(time_ms / step_ms_, 0.0, static_cast<double>(values_.size() - 1));
  const auto k = std::min(static_cast<Eigen::Index>(place), values_.size() - 2);
  const double s = place - static_cast<double>(k);
  return (1 - s) * values_[k] + s * values_[k + 1];
}

const std::vector<ElastodynamicsCase>& elastodynamics_cases() {
  static const std::vector<ElastodynamicsCase> list{
      {.name = "elastodynamics_0A",
       .title = "left ventricle, active",
       .mesh = "lv_volume.vtu",
       .surface = "lv_surface.vtu",
       .envelope = "lv_step_0A_envelope.csv",
       .points = {{"p0", {25, 30, 0}, -30.21, -30.40, -29.37}, {"p1", {0, 30, 0}, -22.13, -22.29, -21.28}},
       .rest_volume_mL = 167.5,
       .least_volume_low_mL = 77.4,
       .least_volume_high_mL = 78.9},
      {.name = "elastodynamics_1",
       .title = "left ventricle, active and under pressure",
       .mesh = "lv_volume.vtu",
       .surface = "lv_surface.vtu",
       .envelope = "lv_step_1_envelope.csv",
       .pressures = {{16, 7, 1}},
       .reduced_percent = 30,
       .points = {{"p0", {25, 30, 0}, -35.50, -35.87, -34.35}, {"p1", {0, 30, 0}, -27.26, -27.57, -26.14}},
       .rest_volume_mL = 167.5,
       .least_volume_low_mL = 81.1,
       .least_volume_high_mL = 82.8},
      {.name = "elastodynamics_biv",
       .title = "both ventricles, active and under pressure",
       .mesh = "biv_volume.vtu",
       .surface = "biv_surface.vtu",
       .envelope = "biv_coarse_envelope.csv",
       .two_ventricles = true,
       .pressures = {{16, 12, 15}, {4, 3, 10}},
       .base_stiffness_kPa_per_mm = 1,
       .element_order = 1,
       .slack_percent = 20,
       .curve_excess_mm = 4.5,
       .points = {{"p0", {25, 30, 0}, 7.95, 7.53, 8.92},
                  {"p1", {0, 30, 0}, 12.68, 10.93, 13.31},
                  {"p2", {25, 0, 72}, 15.09, 13.88, 16.08}}}};
  return list;
}

}  // namespace cardiac
