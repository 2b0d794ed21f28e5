#include "cardiac/run/haemodynamics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <cardiac/core/units.hpp>
#include <cardiac/run/key_states.hpp>
#include <cardiac/scene/loops.hpp>

namespace cardiac {

namespace {

std::shared_ptr<const CirculationModel> model_of(const HeartPath& path, const Scene& scene) {
  return circulation_model(path.circulation.front().pressures_kPa.size() > 1, scene);
}

bool has_whole_beat(const HeartPath& path, const Scene& scene) {
  return !path.circulation.empty() && path.circulation.back().time_ms >= (1 - 1e-6) * scene.time.beat_ms;
}

// What passes a valve, and the pressure drop while it does.
struct Passage {
  ValveVolumes valve;
  double drop_kPa_ms = 0, forward_ms = 0, peak_kPa = 0;

  void add(double flow, double drop, double lasts_ms) {
    (flow > 0 ? valve.forward_mL : valve.regurgitant_mL) += lasts_ms * std::abs(flow) / mm3_per_mL;
    if (!(flow > kLeast_flow)) return;
    drop_kPa_ms += lasts_ms * drop;
    forward_ms += lasts_ms;
    peak_kPa = std::max(peak_kPa, drop);
  }
  ValveVolumes told() const {
    ValveVolumes out = valve;
    out.regurgitant_percent = valve.forward_mL > 0 ? 100 * valve.regurgitant_mL / valve.forward_mL : 0;
    out.mean_gradient_mmHg = forward_ms > 0 ? drop_kPa_ms / forward_ms / kPa_per_mmHg : 0;
    out.peak_gradient_mmHg = peak_kPa / kPa_per_mmHg;
    return out;
  }

  static constexpr double kLeast_flow = 1 * flow_per_mL_per_s;  // a closed valve lets less through
};

}  // namespace

std::optional<Haemodynamics> haemodynamics(const HeartPath& path, const Scene& scene, int cavity) {
  if (!has_whole_beat(path, scene)) return {};
  const double beat = scene.time.beat_ms;
  const auto model = model_of(path, scene);
  const CirculationModel::Names names = model->names(cavity);
  double artery = 0, before = 0, work = 0, net_mm3 = 0;
  double systolic = -std::numeric_limits<double>::infinity(), diastolic = -systolic;
  Passage in{{names.inlet}}, out{{names.outlet}};
  for (std::size_t k = 1; k < path.circulation.size(); ++k) {
    const double half = (path.circulation[k].time_ms - path.circulation[k - 1].time_ms) / 2;
    for (const CirculationSample& s : {path.circulation[k - 1], path.circulation[k]}) {
      const CirculationModel::Side side = model->side(cavity, s.time_ms, s.states, s.pressures_kPa);
      const double p = s.pressures_kPa[cavity];
      in.add(side.inlet_mm3_per_ms, side.before_kPa - p, half);
      out.add(side.outlet_mm3_per_ms, p - side.artery_kPa, half);
      net_mm3 += half * side.outflow_mm3_per_ms;
      artery += half * side.artery_kPa;
      before += half * side.before_kPa;
      work += half * p * (side.outflow_mm3_per_ms - side.inflow_mm3_per_ms);
      systolic = std::max(systolic, side.artery_kPa);
      diastolic = std::min(diastolic, side.artery_kPa);
    }
  }
  Haemodynamics h;
  constexpr double mL_per_L = 1000, uJ_per_mJ = 1000;  // kPa mm³ are µJ
  h.cardiac_output_L_per_min = net_mm3 / mm3_per_mL / beat * ms_per_min / mL_per_L;
  h.stroke_work_mJ = work / uJ_per_mJ;
  h.stroke_work_mmHg_mL = work / kPa_per_mmHg / mm3_per_mL;
  h.arterial_mean_mmHg = artery / beat / kPa_per_mmHg;
  h.arterial_systolic_mmHg = systolic / kPa_per_mmHg;
  h.arterial_diastolic_mmHg = diastolic / kPa_per_mmHg;
  h.venous_mean_mmHg = before / beat / kPa_per_mmHg;
  // As catheters sample; beside valves that close steps of some µs would tell what is left of Newton's
  // method.
  constexpr double kSampled_ms = 1;
  for (std::size_t k = 1, from = 0; k < path.steps.size(); ++k) {
    const HeartState& b = path.steps[k];
    while (from + 1 < k && b.time_ms - path.steps[from + 1].time_ms >= kSampled_ms) ++from;
    const HeartState& a = path.steps[from];
    if (b.time_ms - a.time_ms < kSampled_ms) continue;
    const double rise = b.pressures_kPa[cavity] - a.pressures_kPa[cavity];
    const double rate = rise / kPa_per_mmHg / (b.time_ms - a.time_ms) * ms_per_s;
    h.dp_dt_max_mmHg_per_s = std::max(h.dp_dt_max_mmHg_per_s, rate);
    h.dp_dt_min_mmHg_per_s = std::min(h.dp_dt_min_mmHg_per_s, rate);
  }
  h.valves = {in.told(), out.told()};
  const KeyStates key = key_states(path, scene, cavity);
  const double end_systolic_kPa = key.es.pressures_kPa[cavity],
               stroke_mm3 = key.largest_mm3 - key.smallest_mm3;
  const double area = work + 0.5 * end_systolic_kPa * key.es.volumes_mm3[cavity];
  h.pressure_volume_area_mJ = area / uJ_per_mJ;
  h.pressure_volume_area_mmHg_mL = area / kPa_per_mmHg / mm3_per_mL;
  if (stroke_mm3 > 0)
    h.arterial_elastance_mmHg_per_mL = end_systolic_kPa / stroke_mm3 / elastance_per_mmHg_per_mL;
  return h;
}

std::vector<FlowBalance> flow_balances(const HeartPath& path, const Scene& scene) {
  std::vector<FlowBalance> out;
  if (!has_whole_beat(path, scene)) return out;
  const auto model = model_of(path, scene);
  const double beat = scene.time.beat_ms;
  for (std::size_t k = 1; k < path.circulation.size(); ++k) {
    const double half = (path.circulation[k].time_ms - path.circulation[k - 1].time_ms) / 2;
    for (const CirculationSample& s : {path.circulation[k - 1], path.circulation[k]}) {
      const auto flows = model->balances(s.time_ms, s.states, s.pressures_kPa);
      out.resize(flows.size());
      for (std::size_t i = 0; i < flows.size(); ++i) {
        out[i].name = flows[i].name;
        out[i].mean_inflow_mL_per_s += half / beat * flows[i].inflow_mm3_per_ms / flow_per_mL_per_s;
        out[i].mean_outflow_mL_per_s += half / beat * flows[i].outflow_mm3_per_ms / flow_per_mL_per_s;
      }
    }
  }
  for (FlowBalance& b : out)
    b.error_percent = b.mean_inflow_mL_per_s == 0
                          ? 0
                          : 100 * (b.mean_inflow_mL_per_s - b.mean_outflow_mL_per_s) / b.mean_inflow_mL_per_s;
  return out;
}

CirculationTable circulation_table(const HeartPath& path, const Scene& scene) {
  CirculationTable table;
  if (path.circulation.empty()) return table;
  const auto model = model_of(path, scene);
  const std::array<const char*, 3> unit{"_mmHg", "_mL_per_s", "_mL"};
  const std::array<double, 3> factor{kPa_per_mmHg, flow_per_mL_per_s, mm3_per_mL};
  for (const CirculationSample& s : path.circulation) {
    const auto readings = model->readings(s.time_ms, s.states, s.pressures_kPa);
    if (table.columns.empty()) {
      table.columns.emplace_back("time_ms");
      for (const auto& r : readings)
        table.columns.push_back(r.name + unit.at(static_cast<std::size_t>(r.quantity)));
      table.values.resize(table.columns.size());
    }
    table.values[0].push_back(s.time_ms);
    for (std::size_t i = 0; i < readings.size(); ++i)
      table.values[i + 1].push_back(readings[i].value /
                                    factor.at(static_cast<std::size_t>(readings[i].quantity)));
  }
  return table;
}

}  // namespace cardiac
