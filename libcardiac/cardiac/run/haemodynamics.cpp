#include "cardiac/run/haemodynamics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <cardiac/core/units.hpp>
#include <cardiac/scene/loops.hpp>

namespace cardiac {

namespace {

// Names of what lies about a cavity.
struct SideNames {
  const char *before, *ventricle, *artery, *arteries, *inlet, *outlet, *vessels;
};
constexpr SideNames kLeft{"pulmonary_veins", "left_ventricle", "aorta",           "systemic_arteries",
                          "mitral_valve",    "aortic_valve",   "systemic_vessels"};
constexpr SideNames kRight{"systemic_veins",  "right_ventricle", "pulmonary_artery", "pulmonary_arteries",
                           "tricuspid_valve", "pulmonary_valve", "pulmonary_vessels"};

std::shared_ptr<const CirculationModel> model_of(const HeartPath& path, const Scene& scene) {
  return circulation_model(path.circulation.front().pressures_kPa.size() > 1, *scene.circulation);
}

}  // namespace

std::optional<Haemodynamics> haemodynamics(const HeartPath& path, const Scene& scene, int cavity) {
  const double beat = scene.time.beat_ms;
  if (path.circulation.empty() || path.circulation.back().time_ms < (1 - 1e-6) * beat) return {};
  const auto model = model_of(path, scene);
  const SideNames& names = cavity == 0 ? kLeft : kRight;
  double artery = 0, before = 0, work = 0;
  double systolic = -std::numeric_limits<double>::infinity(), diastolic = -systolic;
  ValveVolumes in{names.inlet}, out{names.outlet};
  const auto through = [](ValveVolumes& valve, double flow, double half) {
    (flow > 0 ? valve.forward_mL : valve.regurgitant_mL) += half * std::abs(flow) / mm3_per_mL;
  };
  for (std::size_t k = 1; k < path.circulation.size(); ++k) {
    const double half = (path.circulation[k].time_ms - path.circulation[k - 1].time_ms) / 2;
    for (const CirculationSample& s : {path.circulation[k - 1], path.circulation[k]}) {
      const CirculationModel::Side side = model->side(cavity, s.states, s.pressures_kPa);
      through(in, side.inflow_mm3_per_ms, half);
      through(out, side.outflow_mm3_per_ms, half);
      artery += half * side.artery_kPa;
      before += half * side.before_kPa;
      work += half * s.pressures_kPa[cavity] * (side.outflow_mm3_per_ms - side.inflow_mm3_per_ms);
      systolic = std::max(systolic, side.artery_kPa);
      diastolic = std::min(diastolic, side.artery_kPa);
    }
  }
  Haemodynamics h;
  constexpr double mL_per_L = 1000;
  h.cardiac_output_L_per_min = (out.forward_mL - out.regurgitant_mL) / beat * ms_per_min / mL_per_L;
  h.stroke_work_mJ = work / 1000;  // kPa mm³ are µJ
  h.stroke_work_mmHg_mL = work / kPa_per_mmHg / mm3_per_mL;
  h.arterial_mean_mmHg = artery / beat / kPa_per_mmHg;
  h.arterial_systolic_mmHg = systolic / kPa_per_mmHg;
  h.arterial_diastolic_mmHg = diastolic / kPa_per_mmHg;
  h.venous_mean_mmHg = before / beat / kPa_per_mmHg;
  for (std::size_t k = 1; k < path.steps.size(); ++k) {
    const HeartState &a = path.steps[k - 1], &b = path.steps[k];
    const double rise = b.pressures_kPa[cavity] - a.pressures_kPa[cavity];
    const double rate = rise / kPa_per_mmHg / (b.time_ms - a.time_ms) * ms_per_s;
    h.dp_dt_max_mmHg_per_s = std::max(h.dp_dt_max_mmHg_per_s, rate);
    h.dp_dt_min_mmHg_per_s = std::min(h.dp_dt_min_mmHg_per_s, rate);
  }
  for (ValveVolumes* valve : {&in, &out})
    valve->regurgitant_percent = valve->forward_mL > 0 ? 100 * valve->regurgitant_mL / valve->forward_mL : 0;
  h.valves = {in, out};
  return h;
}

CirculationTable circulation_table(const HeartPath& path, const Scene& scene) {
  CirculationTable table;
  if (path.circulation.empty()) return table;
  const auto model = model_of(path, scene);
  const int cavities = model->num_cavities();
  const bool closed = model->is_closed();
  const auto column = [&](const std::string& name, const char* unit, auto&& value) {
    table.columns.push_back(name + unit);
    std::vector<double>& values = table.values.emplace_back();
    for (const CirculationSample& s : path.circulation) values.push_back(value(s));
  };
  column("time", "_ms", [](const CirculationSample& s) { return s.time_ms; });
  for (int k = 0; k < cavities; ++k) {
    const SideNames& names = k == 0 ? kLeft : kRight;
    const auto side = [&model, k](const CirculationSample& s) {
      return model->side(k, s.states, s.pressures_kPa);
    };
    const auto pressure = [&](const char* name, double CirculationModel::Side::*member) {
      column(name, "_mmHg", [&](const CirculationSample& s) { return side(s).*member / kPa_per_mmHg; });
    };
    const auto flow = [&](const char* name, double CirculationModel::Side::*member) {
      column(name, "_mL_per_s",
             [&](const CirculationSample& s) { return side(s).*member / flow_per_mL_per_s; });
    };
    pressure(names.before, &CirculationModel::Side::before_kPa);
    column(names.ventricle, "_mmHg",
           [k](const CirculationSample& s) { return s.pressures_kPa[k] / kPa_per_mmHg; });
    pressure(names.artery, &CirculationModel::Side::artery_kPa);
    pressure(names.arteries, &CirculationModel::Side::capacitor_kPa);
    if (!closed) pressure(kRight.before, &CirculationModel::Side::behind_kPa);
    flow(names.inlet, &CirculationModel::Side::inflow_mm3_per_ms);
    flow(names.outlet, &CirculationModel::Side::outflow_mm3_per_ms);
    flow(names.vessels, &CirculationModel::Side::run_off_mm3_per_ms);
    column(names.ventricle, "_mL", [k](const CirculationSample& s) { return s.states[k] / mm3_per_mL; });
  }
  return table;
}

}  // namespace cardiac
