#include "cardiac/run/beat_instants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Vector;

namespace {

constexpr int kParts = 4;        // of a step, at which signs are compared
constexpr int kBisections = 12;  // of such a part: 1e-3 ms of the longest step

enum Row { inlet_drop, outlet_drop, filling_flow, rows };

// Of each cavity: the pressure drops over its valves (kPa) and the rate of its volume (mm³/ms).
Matrix signs(const CoupledHeart& heart, double t, const Vector& y) {
  const CirculationModel& circulation = *heart.circulation;
  const Vector z = heart.states(y), p = heart.pressures.of(y);
  Matrix out(static_cast<Eigen::Index>(rows), p.size());
  for (int k = 0; k < p.size(); ++k) {
    const CirculationModel::Side side = circulation.side(k, t, z, p);
    out.col(k) << side.before_kPa - p[k], p[k] - side.capacitor_kPa,
        side.inflow_mm3_per_ms - side.outflow_mm3_per_ms;
  }
  return out;
}

void keep(std::optional<HeartState>& best, HeartState&& state, int cavity, bool largest) {
  const auto volume = [cavity](const HeartState& s) { return s.volumes_mm3[cavity]; };
  if (!best || (volume(state) > volume(*best)) == largest) best = std::move(state);
}

}  // namespace

double contraction_onset_ms(const ContractionField& contraction) {
  double first = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < contraction.delay_ms.size(); ++i)
    if (contraction.scale[i] > 0) first = std::min(first, contraction.delay_ms[i]);
  if (!std::isfinite(first)) first = 0;
  const double onset = first + contraction.begin_ms, period = contraction.curve.period_ms();
  return onset < 0 ? 0 : onset - period * std::floor(onset / period);
}

BeatInstants::BeatInstants(const CoupledHeart& heart, double begin_ms, double onset_ms, const Vector& y,
                           HeartPath& path)
    : heart_(heart),
      begin_ms_(begin_ms),
      onset_ms_(onset_ms),
      path_(path),
      before_(signs(heart, begin_ms, y)) {
  path_.instants.assign(static_cast<std::size_t>(before_.cols()), {});
  path_.contraction_begins.reset();
  path_.circulation.clear();
  if (onset_ms_ <= 0) path_.contraction_begins = heart_.unpack(0, y);
  sample(begin_ms, y);
}

void BeatInstants::sample(double t, const Vector& y) {
  path_.circulation.push_back({t - begin_ms_, heart_.states(y), heart_.pressures.of(y)});
}

void BeatInstants::follow(const polyaffine::DaeIntegrator& ida, double from_ms) {
  Vector y;
  const double part = (ida.time() - from_ms) / kParts;
  const auto state_at = [&](double t) {
    ida.interpolate(t, y);
    return heart_.unpack(t - begin_ms_, y);
  };
  const double onset = begin_ms_ + onset_ms_;
  if (!path_.contraction_begins && onset <= ida.time())
    path_.contraction_begins = state_at(std::max(onset, from_ms));
  for (int i = 1; i <= kParts; ++i) {
    const double low = from_ms + (i - 1) * part, high = i == kParts ? ida.time() : from_ms + i * part;
    ida.interpolate(high, y);
    sample(high, y);
    const Matrix now = signs(heart_, high, y);
    for (int k = 0; k < now.cols(); ++k)
      for (int row = 0; row < rows; ++row) {
        const bool falls = before_(row, k) > 0 && now(row, k) <= 0;
        const bool rises = before_(row, k) <= 0 && now(row, k) > 0;
        if (!falls && !(rises && row == filling_flow)) continue;
        double a = low, b = high;
        for (int n = 0; n < kBisections; ++n) {
          const double middle = (a + b) / 2;
          ida.interpolate(middle, y);
          ((signs(heart_, middle, y)(row, k) > 0) == falls ? a : b) = middle;
        }
        CavityInstants& instants = path_.instants[static_cast<std::size_t>(k)];
        if (row == inlet_drop) keep(instants.inlet_closes, state_at(b), k, true);
        if (row == outlet_drop) keep(instants.outlet_closes, state_at(b), k, false);
        if (row == filling_flow && falls) keep(instants.largest, state_at(b), k, true);
        if (row == filling_flow && rises) keep(instants.smallest, state_at(b), k, false);
      }
    before_ = now;
  }
}

}  // namespace cardiac
