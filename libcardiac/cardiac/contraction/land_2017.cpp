#include "cardiac/contraction/land_2017.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include <polyaffine/material/parameters.hpp>

namespace cardiac {
namespace {

enum State { troponin, blocked, weak, strong, weak_distortion, strong_distortion };

// Of the rate at which tropomyosin blocks, k_b CaTRPN^(−n/2): as in the authors' code, or it is infinite
// without calcium.
constexpr double kMostBlocking = 100;
constexpr double kLongest = 1.2;  // stretch, beyond which calcium sensitivity no longer rises

// Calcium over that of half activation, to the power n, with its derivative by the stretch.
struct Binding {
  double value, by_stretch;
};

Binding binding(const LandParameters& p, double calcium_uM, double stretch) {
  // The paper's range of stretch leaves it positive; far beyond, sensitivity no longer rises.
  constexpr double kLeast = 0.1;
  const double at = p.calcium_50_uM + p.calcium_slope_uM * (std::min(stretch, kLongest) - 1);
  const double half = std::max(kLeast * p.calcium_50_uM, at);
  const double value = std::pow(calcium_uM / half, p.n_TRPN);
  const bool moves = stretch < kLongest && at > kLeast * p.calcium_50_uM;
  return {value, moves ? -p.n_TRPN * value * p.calcium_slope_uM / half : 0};
}

}  // namespace

Land2017::Land2017(const LandParameters& parameters) : p_(parameters) {
  polyaffine::require_positive("contraction: calcium of half activation", p_.calcium_50_uM, "uM");
  polyaffine::require_positive("contraction: factor on times", p_.time_factor, "1 (dimensionless)");
  for (double* rate : {&p_.k_uw, &p_.k_ws, &p_.gamma_s, &p_.gamma_w, &p_.k_TRPN, &p_.k_u})
    *rate /= p_.time_factor;
  const double free = (1 - p_.r_s) * (1 - p_.r_w), held = (1 - p_.r_s) * p_.r_w;
  k_wu_ = p_.k_uw * (1 / p_.r_w - 1) - p_.k_ws;
  k_su_ = p_.k_ws * (1 / p_.r_s - 1) * p_.r_w;
  k_b_ = p_.k_u * std::pow(p_.TRPN_50, p_.n_Tm) / (1 - p_.r_s - held);
  A_ = p_.A_eff * p_.r_s / (held + p_.r_s);
  c_w_ = p_.phi * p_.k_uw * free / held;
  c_s_ = p_.phi * p_.k_ws * held / p_.r_s;
}

void Land2017::respond(const FibreMotion& at, const States& z, bool derivatives, SarcomereResponse& r) const {
  const double U = 1 - z[blocked] - z[strong] - z[weak];
  const Binding bound = binding(p_, at.drive, at.stretch);
  const double half = p_.n_Tm / 2, troponin_now = std::max(z[troponin], 1e-12);
  const double opening = std::pow(troponin_now, half);
  const bool capped = opening * kMostBlocking < 1;
  const double blocking = capped ? kMostBlocking : 1 / opening;
  const double zeta_s = z[strong_distortion], zeta_w = z[weak_distortion];
  const double gamma_w = p_.gamma_w * std::abs(zeta_w);
  const double gamma_s = p_.gamma_s * (zeta_s > 0 ? zeta_s : std::max(0.0, -zeta_s - 1));
  const double out_w = k_wu_ + p_.k_ws + gamma_w, out_s = k_su_ + gamma_s;
  r.rates[troponin] = p_.k_TRPN * (bound.value * (1 - z[troponin]) - z[troponin]);
  r.rates[blocked] = k_b_ * blocking * U - p_.k_u * opening * z[blocked];
  r.rates[weak] = p_.k_uw * U - out_w * z[weak];
  r.rates[strong] = p_.k_ws * z[weak] - out_s * z[strong];
  r.rates[weak_distortion] = A_ * at.rate_per_ms - c_w_ * zeta_w;
  r.rates[strong_distortion] = A_ * at.rate_per_ms - c_s_ * zeta_s;
  const Overlap overlap = filament_overlap(at.stretch, p_.overlap_slope);
  const double scale = p_.reference_tension_kPa / p_.r_s;
  const double bridges = z[strong] * (zeta_s + 1) + z[weak] * zeta_w;
  r.tension_kPa = overlap.value * scale * bridges;
  if (!derivatives) return;
  r.by_stretch = overlap.slope * scale * bridges;
  const double held = overlap.value * scale;
  r.by_state = {0, 0, held * zeta_w, held * (zeta_s + 1), held * z[weak], held * z[strong]};
  r.rates_by_stretch = {p_.k_TRPN * bound.by_stretch * (1 - z[troponin]), 0, 0, 0, 0, 0};
  r.rates_by_rate = {0, 0, 0, 0, A_, A_};
  auto& J = r.rates_by_state;
  const double opening_by = half * opening / troponin_now;
  const double blocking_by = capped ? 0 : -half * blocking / troponin_now;
  const double gamma_w_by = zeta_w > 0 ? p_.gamma_w : zeta_w < 0 ? -p_.gamma_w : 0;
  const double gamma_s_by = zeta_s > 0 ? p_.gamma_s : zeta_s < -1 ? -p_.gamma_s : 0;
  J[troponin] = {-p_.k_TRPN * (bound.value + 1), 0, 0, 0, 0, 0};
  J[blocked] = {k_b_ * blocking_by * U - p_.k_u * opening_by * z[blocked],
                -k_b_ * blocking - p_.k_u * opening,
                -k_b_ * blocking,
                -k_b_ * blocking,
                0,
                0};
  J[weak] = {0, -p_.k_uw, -p_.k_uw - out_w, -p_.k_uw, -gamma_w_by * z[weak], 0};
  J[strong] = {0, 0, p_.k_ws, -out_s, 0, -gamma_s_by * z[strong]};
  J[weak_distortion] = {0, 0, 0, 0, -c_w_, 0};
  J[strong_distortion] = {0, 0, 0, 0, 0, -c_s_};
}

// Without distortion the rates of B, W and S are linear in them.
SarcomereModel::States Land2017::at_rest(double drive, double stretch) const {
  const double bound = binding(p_, drive, stretch).value;
  States z{};
  z[troponin] = bound / (1 + bound);
  SarcomereResponse r;
  respond({drive, stretch, 0}, z, true, r);
  Eigen::Matrix3d J;
  Eigen::Vector3d g;
  for (int i = 0; i < 3; ++i) {
    g[i] = r.rates[blocked + i];
    for (int j = 0; j < 3; ++j) J(i, j) = r.rates_by_state[blocked + i][blocked + j];
  }
  const Eigen::Vector3d bridges = -J.partialPivLu().solve(g);
  for (int i = 0; i < 3; ++i) z[blocked + i] = bridges[i];
  return z;
}

}  // namespace cardiac
