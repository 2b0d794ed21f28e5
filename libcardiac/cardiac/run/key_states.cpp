#include "cardiac/run/key_states.hpp"

#include <algorithm>
#include <cmath>

#include <cardiac/scene/loops.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

double volume(const HeartState& s, int cavity) {
  return s.volumes_mm3[cavity];
}

double pressure(const HeartState& s, int cavity) {
  return s.pressures_kPa[cavity];
}

// What lies about a cavity at each step of a path.
struct Surroundings {
  Vector before, pressure, capacitor;
  std::vector<Phase> by_valves;
};

Surroundings surroundings(const HeartPath& path, const Scene& scene, int cavity) {
  const auto model = circulation_model(path.steps.front().volumes_mm3.size() > 1, scene);
  const auto n = static_cast<Eigen::Index>(path.steps.size());
  Surroundings out{Vector(n), Vector(n), Vector(n), {}};
  for (Eigen::Index k = 0; k < n; ++k) {
    const HeartState& s = path.steps[static_cast<std::size_t>(k)];
    const CirculationModel::Side side = model->side(cavity, s.time_ms, s.circulation(), s.pressures_kPa);
    out.before[k] = side.before_kPa;
    out.pressure[k] = pressure(s, cavity);
    out.capacitor[k] = side.capacitor_kPa;
  }
  out.by_valves = classify_phases(model->inlet(cavity), model->outlet_valve(cavity), out.before, out.pressure,
                                  out.capacitor);
  return out;
}

// Whether the outlet lets anything through at some step.
bool ejects(const Surroundings& around) {
  return std::ranges::find(around.by_valves, Phase::ejection) != around.by_valves.end();
}

// Whether the inlet is closed at some step: where it is and was never seen to close, it has been from the
// beginning of the beat, as when the wall begins it in equilibrium with the pressure before the inlet.
bool holds_back(const Surroundings& around) {
  return ((around.pressure - around.before).array() > 0).any();
}

void set_phases(const HeartPath& path, const Surroundings& around, double period, int cavity,
                KeyStates& out) {
  const auto& steps = path.steps;
  out.phases = around.by_valves;
  if (!ejects(around)) return;
  const auto after = [period](double t, double from) {
    return t - from - period * std::floor((t - from) / period);
  };
  const double systole = after(out.es.time_ms, out.ed.time_ms);
  std::vector<std::size_t> order(steps.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  // From end diastole on; the first and the last step of a beat are the same instant.
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return after(steps[k].time_ms, out.ed.time_ms); });
  const bool closes = path.instants[static_cast<std::size_t>(cavity)].outlet_closes.has_value();
  bool ejecting = !closes, relaxing = closes;
  for (const std::size_t k : order) {
    const bool in_systole = after(steps[k].time_ms, out.ed.time_ms) <= systole;
    const double v = volume(steps[k], cavity);
    if (in_systole) {
      ejecting = ejecting || around.pressure[static_cast<Eigen::Index>(k)] >
                                 around.capacitor[static_cast<Eigen::Index>(k)];
      out.phases[k] = ejecting ? Phase::ejection : Phase::isovolumetric_contraction;
      if (!ejecting) out.contraction_change_mm3 = v - volume(out.ed, cavity);
    } else {
      relaxing = relaxing &&
                 around.pressure[static_cast<Eigen::Index>(k)] > around.before[static_cast<Eigen::Index>(k)];
      out.phases[k] = relaxing ? Phase::isovolumetric_relaxation : Phase::filling;
      if (relaxing) out.relaxation_change_mm3 = v - volume(out.es, cavity);
    }
  }
}

KeyStates of_beat(const HeartPath& path, const Scene& scene, int cavity) {
  const auto& steps = path.steps;
  const auto by_volume = [cavity](const HeartState& a, const HeartState& b) {
    return volume(a, cavity) < volume(b, cavity);
  };
  const auto [low, high] = std::ranges::minmax_element(steps, by_volume);
  const HeartState& top =
      *std::ranges::max_element(steps, {}, [cavity](const HeartState& s) { return pressure(s, cavity); });
  const double period = scene.time.beat_ms;
  const CavityInstants none;
  const CavityInstants& at = path.instants.empty() ? none : path.instants[static_cast<std::size_t>(cavity)];

  KeyStates out;
  out.ed = at.largest ? *at.largest : *high;
  out.ed_is = "largest volume";
  out.es = at.smallest ? *at.smallest : *low;
  out.es_is = "smallest volume";
  out.largest_mm3 = std::max(volume(out.ed, cavity), volume(*high, cavity));
  out.smallest_mm3 = std::min(volume(out.es, cavity), volume(*low, cavity));
  const auto lead = [&](const HeartState& s) {
    const double t = top.time_ms - s.time_ms;
    return t - period * std::floor(t / period);
  };
  if (at.inlet_closes) {
    out.ed = *at.inlet_closes;
    out.ed_is = "closing of the inlet valve";
    if (path.contraction_begins && lead(*path.contraction_begins) < lead(out.ed)) {
      out.ed = *path.contraction_begins;
      out.ed_is = "onset of contraction";
    }
  }
  if (at.outlet_closes) {
    out.es = *at.outlet_closes;
    out.es_is = "closing of the outlet valve";
  }
  if (path.instants.empty()) return out;
  const Surroundings around = surroundings(path, scene, cavity);
  if (!at.inlet_closes && path.contraction_begins && holds_back(around)) {
    out.ed = *path.contraction_begins;
    out.ed_is = "onset of contraction";
  }
  set_phases(path, around, period, cavity, out);
  return out;
}

KeyStates of_loading(const HeartPath& path, const Scene& scene, int cavity) {
  const auto& steps = path.steps;
  KeyStates out{.ed = steps.front(),
                .es = steps.back(),
                .ed_is = "begin of the loading",
                .es_is = "end of the loading",
                .phases = {}};
  if (path.contraction_begins) {
    out.ed = *path.contraction_begins;
    out.ed_is = "onset of contraction";
    const double end = out.ed.time_ms + scene.time.beat_ms;
    const HeartState* least = &out.ed;
    for (const HeartState& s : steps)
      if (s.time_ms > out.ed.time_ms && s.time_ms <= end && volume(s, cavity) < volume(*least, cavity))
        least = &s;
    if (least != &out.ed) {
      out.es = *least;
      out.es_is = "smallest volume";
    } else if (path.contraction_ends) {
      out.es = *path.contraction_ends;
      out.es_is = "end of contraction";
    }
  }
  out.largest_mm3 = volume(out.ed, cavity);
  out.smallest_mm3 = volume(out.es, cavity);
  return out;
}

}  // namespace

KeyStates key_states(const HeartPath& path, const Scene& scene, int cavity) {
  return scene.circulation ? of_beat(path, scene, cavity) : of_loading(path, scene, cavity);
}

std::vector<std::string> valve_warnings(const HeartPath& path, const Scene& scene, int cavity) {
  if (path.instants.empty() || !path.completed) return {};
  const auto model = circulation_model(path.steps.front().volumes_mm3.size() > 1, scene);
  auto [before, ventricle, artery, arteries, inlet, outlet, vessels] = model->names(cavity);
  std::ranges::replace(inlet, '_', ' ');
  std::ranges::replace(outlet, '_', ' ');
  const CavityInstants& at = path.instants[static_cast<std::size_t>(cavity)];
  std::vector<std::string> out;
  const Surroundings around = surroundings(path, scene, cavity);
  if (!ejects(around))
    out.push_back("the " + outlet +
                  " never opens: the pressure of the ventricle stays below that of the arteries");
  else if (!at.outlet_closes)
    out.push_back(
        "the " + outlet +
        " never closes: the pressure of the arteries never exceeds that of the ventricle (a "
        "peripheral resistance or compliance too small for this heart?); end systole is the smallest "
        "volume");
  if (!at.inlet_closes && !holds_back(around))
    out.push_back("the " + inlet +
                  " never closes: the pressure of the ventricle never exceeds that before it; end diastole "
                  "is the largest volume");
  return out;
}

}  // namespace cardiac
