#include <cardiac/report/summary.hpp>

#include <cmath>
#include <nlohmann/json.hpp>

#include <cardiac/report/filling.hpp>
#include <cardiac/report/global_columns.hpp>
#include <cardiac/report/text.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

using Json = nlohmann::ordered_json;
using polyaffine::InputError;

Json number(double value) {
  return std::isfinite(value) ? Json(rounded_for_files(value)) : Json(nullptr);
}

Json ventricle_json(const VentricleSummary& v, const BeatResult& r) {
  const bool contracts = r.has_beat || r.has_contraction;
  const auto of_beat = [contracts](double value) { return contracts ? number(value) : Json(nullptr); };
  Json json = {{"edv_mL", of_beat(v.edv_mL)},
               {"esv_mL", of_beat(v.esv_mL)},
               {"sv_mL", of_beat(v.sv_mL)},
               {"ef_percent", of_beat(v.ef_percent)},
               {"peak_pressure_mmHg", of_beat(v.peak_pressure_mmHg)},
               {"edp_mmHg", of_beat(v.edp_mmHg)},
               {"ed_time_ms", number(v.ed_time_ms)},
               {"es_time_ms", number(v.es_time_ms)},
               {"ed_is", v.ed_is},
               {"es_is", v.es_is},
               {"isovolumetric_contraction_change_mL", of_beat(v.isovolumetric_contraction_change_mL)},
               {"isovolumetric_relaxation_change_mL", of_beat(v.isovolumetric_relaxation_change_mL)}};
  if (!r.has_beat && !v.samples.empty()) {
    json["volume_mL"] = number(v.samples.back().volume_mL);
    json["pressure_mmHg"] = number(v.samples.back().pressure_mmHg);
  }
  return json;
}

Json haemodynamics_json(const Haemodynamics& h) {
  Json valves = Json::object();
  for (const ValveVolumes& valve : h.valves)
    valves[valve.name] = {{"forward_mL", number(valve.forward_mL)},
                          {"regurgitant_mL", number(valve.regurgitant_mL)},
                          {"regurgitant_percent", number(valve.regurgitant_percent)},
                          {"mean_gradient_mmHg", number(valve.mean_gradient_mmHg)},
                          {"peak_gradient_mmHg", number(valve.peak_gradient_mmHg)}};
  return {{"cardiac_output_L_per_min", number(h.cardiac_output_L_per_min)},
          {"stroke_work_mmHg_mL", number(h.stroke_work_mmHg_mL)},
          {"stroke_work_mJ", number(h.stroke_work_mJ)},
          {"dp_dt_max_mmHg_per_s", number(h.dp_dt_max_mmHg_per_s)},
          {"dp_dt_min_mmHg_per_s", number(h.dp_dt_min_mmHg_per_s)},
          {"arterial_mean_mmHg", number(h.arterial_mean_mmHg)},
          {"arterial_systolic_mmHg", number(h.arterial_systolic_mmHg)},
          {"arterial_diastolic_mmHg", number(h.arterial_diastolic_mmHg)},
          {"venous_mean_mmHg", number(h.venous_mean_mmHg)},
          {"pressure_volume_area_mmHg_mL", number(h.pressure_volume_area_mmHg_mL)},
          {"pressure_volume_area_mJ", number(h.pressure_volume_area_mJ)},
          {"arterial_elastance_mmHg_per_mL", number(h.arterial_elastance_mmHg_per_mL)},
          {"valves", valves}};
}

Json balances_json(const std::vector<FlowBalance>& balances) {
  Json out = Json::object();
  for (const FlowBalance& b : balances)
    out[b.name] = {{"mean_inflow_mL_per_s", number(b.mean_inflow_mL_per_s)},
                   {"mean_outflow_mL_per_s", number(b.mean_outflow_mL_per_s)},
                   {"error_percent", number(b.error_percent)}};
  return out;
}

// Seconds of the solve and what they went to; the rest is the integrator's own work and the output states.
Json timing_of(const BeatResult& r) {
  if (!r.has_beat) return nullptr;
  const SolveCost& c = r.cost;
  const double known = c.filling_s + c.residual_s + c.tangent_s + c.factorisation_s + c.linear_solve_s;
  return {{"residuals", c.residuals},
          {"factorisations", c.factorisations},
          {"linear_solves", c.linear_solves},
          {"error_test_failures", c.error_test_failures},
          {"convergence_failures", c.convergence_failures},
          {"filling_s", number(c.filling_s)},
          {"residual_s", number(c.residual_s)},
          {"tangent_s", number(c.tangent_s)},
          {"factorisation_s", number(c.factorisation_s)},
          {"linear_solve_s", number(c.linear_solve_s)},
          {"rest_s", number(r.wall_solve_s - known)}};
}

Json energy_json(const EnergyBalance& e) {
  return {{"active_mJ", number(e.active_mJ)},     {"cavities_mJ", number(e.cavities_mJ)},
          {"elastic_mJ", number(e.elastic_mJ)},   {"supports_mJ", number(e.supports_mJ)},
          {"kinetic_mJ", number(e.kinetic_mJ)},   {"viscosity_mJ", number(e.viscosity_mJ)},
          {"dashpots_mJ", number(e.dashpots_mJ)}, {"residual_mJ", number(e.residual())}};
}

Json global_json(const GlobalStrain& strain) {
  Json json;
  for (const GlobalColumn& quantity : kGlobalStrain) json[quantity.key] = number(quantity.value(strain));
  return json;
}

Json protocol_of(const RunInfo& info) {
  Json protocol = Json::parse(info.protocol_json, nullptr, false);
  if (protocol.is_discarded()) throw InputError("the resolved protocol of the run is not valid JSON");
  return protocol;
}

Json unloading_json(const UnloadingResult& u) {
  Json cavities = Json::object();
  for (const UnloadedCavity& c : u.cavities) {
    Json pressures = Json::array(), volumes = Json::array();
    for (const double p : c.pressures_mmHg) pressures.push_back(number(p));
    for (const double V : c.volumes_mL) volumes.push_back(number(V));
    cavities[c.name] = {{"pressure_mmHg", number(c.pressure_mmHg)},
                        {"imaged_mL", number(c.imaged_mL)},
                        {"unloaded_mL", number(c.unloaded_mL)},
                        {"reloaded_mL", number(c.reloaded_mL)},
                        {"filling_mmHg", pressures},
                        {"filling_mL", volumes}};
    if (c.name == "lv" && c.pressure_mmHg > 0) {
      cavities[c.name]["klotz_unloaded_mL"] = number(klotz_volume_mL(c.imaged_mL, c.pressure_mmHg, 0));
      cavities[c.name]["klotz_at_30_mmHg_mL"] = number(klotz_volume_mL(c.imaged_mL, c.pressure_mmHg, 30));
    }
  }
  return {{"method", u.method},
          {"inflations", u.inflations},
          {"distance_mm", number(u.distance_mm)},
          {"mean_distance_mm", number(u.mean_distance_mm)},
          {"longest_way_mm", number(u.longest_way_mm)},
          {"wall_time_s", number(u.wall_time_s)},
          {"cavities", cavities}};
}

Json lists_of(const BeatResult& r) {
  Json verification = Json::array(), estimates = Json::array(), plan = Json::array(),
       segments = Json::array();
  for (const VerificationInstant& v : r.verification) {
    verification.push_back({{"instant", v.instant},
                            {"time_ms", number(v.time_ms)},
                            {"displacement_error_percent", number(v.displacement_error_percent)},
                            {"volume_error_percent", number(v.volume_error_percent)},
                            {"max_segment_strain_error", number(v.max_segment_strain_error)},
                            {"wall_time_s", number(v.wall_time_s)}});
  }
  for (const EstimatedError& e : r.estimated_errors)
    estimates.push_back(
        {{"instant", e.instant}, {"displacement_error_percent", number(e.displacement_percent)}});
  for (const PlanItem& item : r.plan)
    plan.push_back({{"part", item.part}, {"built", item.built}, {"why", item.why}});
  for (const SegmentInfo& s : r.segments) {
    segments.push_back({{"number", s.number},
                        {"name", s.name},
                        {"volume_mL", number(s.volume_mL)},
                        {"activation_ms", s.activation_ms ? number(*s.activation_ms) : Json(nullptr)}});
  }
  return {{"estimated_errors", estimates},
          {"verification", verification},
          {"segments", segments},
          {"plan", plan},
          {"warnings", r.warnings}};
}

}  // namespace

std::string summary_text(const BeatResult& r, const RunInfo& info) {
  Json ventricles = Json::object();
  Json haemodynamics = Json::object();
  for (const VentricleSummary& v : r.ventricles) {
    ventricles[v.name] = ventricle_json(v, r);
    if (v.haemodynamics) haemodynamics[v.name] = haemodynamics_json(*v.haemodynamics);
  }
  Json json = {{"program", "cardiac"},
               {"version", info.version},
               {"completed", r.completed},
               {"stop_reason", r.stop_reason},
               {"method", r.method},
               {"seed", info.seed},
               {"has_beat", r.has_beat},
               {"has_contraction", r.has_contraction},
               {"mesh", {{"vertices", r.mesh_vertices}, {"tets", r.mesh_tets}}},
               {"dofs", r.dofs},
               {"control_nodes", r.control_nodes},
               {"integration_points", r.integration_points},
               {"beats", r.beats},
               {"time_steps", r.time_steps},
               {"newton_iterations", r.newton_iterations},
               {"simulated_time_s", number(r.simulated_time_s)},
               {"wall_time_s",
                {{"setup", number(r.wall_setup_s)},
                 {"solve", number(r.wall_solve_s)},
                 {"output", number(r.wall_output_s)},
                 {"total", number(r.wall_total_s)}}},
               {"timing", timing_of(r)},
               {"real_time_factor", number(r.wall_solve_s / r.simulated_time_s)},
               {"ventricles", ventricles},
               {"haemodynamics", haemodynamics},
               {"flow_balances", balances_json(r.balances)},
               {"energy_balance_percent", r.energy ? number(r.energy->percent()) : Json(nullptr)},
               {"energy", r.energy ? energy_json(*r.energy) : Json(nullptr)},
               {"strain", global_json(r.strain)},
               {"min_det_F", number(r.min_det_F)},
               {"max_det_F", number(r.max_det_F)}};
  if (r.right_strain) json["right_strain"] = global_json(*r.right_strain);
  if (r.unloading) json["unloading"] = unloading_json(*r.unloading);
  json.update(lists_of(r));
  json["protocol"] = protocol_of(info);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cardiac
