#include <cardiac/report/summary_reader.hpp>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include <cardiac/report/global_columns.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

using Json = nlohmann::ordered_json;
using polyaffine::InputError;

/// One place of a JSON document that is read strictly: every miss names file and key.
class Reader {
 public:
  Reader(const Json& json, std::string key, std::string file)
      : json_(json), key_(std::move(key)), file_(std::move(file)) {}

  Reader at(const std::string& key) const {
    const std::string full = key_.empty() ? key : key_ + "." + key;
    expect(json_.is_object(), "an object");
    if (!json_.contains(key)) throw InputError(file_ + ": the key '" + full + "' is missing");
    return {json_.at(key), full, file_};
  }
  bool has(const std::string& key) const { return json_.is_object() && json_.contains(key); }
  std::vector<Reader> items() const {
    expect(json_.is_array(), "a list");
    std::vector<Reader> list;
    for (const Json& item : json_)
      list.emplace_back(item, key_ + "[" + std::to_string(list.size()) + "]", file_);
    return list;
  }
  std::vector<std::pair<std::string, Reader>> entries() const {
    expect(json_.is_object(), "an object");
    std::vector<std::pair<std::string, Reader>> list;
    for (const auto& [name, value] : json_.items())
      list.emplace_back(name, Reader(value, key_ + "." + name, file_));
    return list;
  }
  void operator>>(double& value) const {
    expect(json_.is_number() || json_.is_null(), "a number or null");
    value = json_.is_null() ? std::numeric_limits<double>::quiet_NaN() : json_.get<double>();
  }
  void operator>>(std::optional<double>& value) const {
    value.reset();
    if (!json_.is_null()) *this >> value.emplace();
  }
  void operator>>(int& value) const {
    expect(json_.is_number_integer(), "an integer");
    value = json_.get<int>();
  }
  void operator>>(long& value) const {
    expect(json_.is_number_integer(), "an integer");
    value = json_.get<long>();
  }
  void operator>>(std::uint64_t& value) const {
    expect(json_.is_number_unsigned(), "a non-negative integer");
    value = json_.get<std::uint64_t>();
  }
  void operator>>(bool& value) const {
    expect(json_.is_boolean(), "true or false");
    value = json_.get<bool>();
  }
  void operator>>(std::string& value) const {
    expect(json_.is_string(), "a text");
    value = json_.get<std::string>();
  }
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
    throw InputError(file_ + ": '" + key_ + "' holds " + found + ", expected " + expected);
  }
  std::string dump() const { return json_.dump(2); }

 private:
  void expect(bool fits, const char* what) const {
    if (fits) return;
    throw InputError(file_ + ": '" + key_ + "' is " + json_.type_name() + ", expected " + what);
  }

  const Json& json_;
  std::string key_, file_;
};

void read_ventricles(const Reader& reader, BeatResult& r) {
  for (const auto& [name, json] : reader.entries()) {
    VentricleSummary& v = r.ventricles.emplace_back();
    v.name = name;
    json.at("edv_mL") >> v.edv_mL;
    json.at("esv_mL") >> v.esv_mL;
    json.at("sv_mL") >> v.sv_mL;
    json.at("ef_percent") >> v.ef_percent;
    json.at("peak_pressure_mmHg") >> v.peak_pressure_mmHg;
    json.at("edp_mmHg") >> v.edp_mmHg;
    json.at("ed_time_ms") >> v.ed_time_ms;
    json.at("es_time_ms") >> v.es_time_ms;
    json.at("ed_is") >> v.ed_is;
    json.at("es_is") >> v.es_is;
    json.at("isovolumetric_contraction_change_mL") >> v.isovolumetric_contraction_change_mL;
    json.at("isovolumetric_relaxation_change_mL") >> v.isovolumetric_relaxation_change_mL;
  }
}

void read_haemodynamics(const Reader& reader, BeatResult& r) {
  for (const auto& [name, json] : reader.entries()) {
    const auto v = std::ranges::find(r.ventricles, name, &VentricleSummary::name);
    if (v == r.ventricles.end()) reader.fail("ventricles that 'ventricles' has", "'" + name + "'");
    Haemodynamics& h = v->haemodynamics.emplace();
    json.at("cardiac_output_L_per_min") >> h.cardiac_output_L_per_min;
    json.at("stroke_work_mmHg_mL") >> h.stroke_work_mmHg_mL;
    json.at("stroke_work_mJ") >> h.stroke_work_mJ;
    json.at("dp_dt_max_mmHg_per_s") >> h.dp_dt_max_mmHg_per_s;
    json.at("dp_dt_min_mmHg_per_s") >> h.dp_dt_min_mmHg_per_s;
    json.at("arterial_mean_mmHg") >> h.arterial_mean_mmHg;
    json.at("arterial_systolic_mmHg") >> h.arterial_systolic_mmHg;
    json.at("arterial_diastolic_mmHg") >> h.arterial_diastolic_mmHg;
    json.at("venous_mean_mmHg") >> h.venous_mean_mmHg;
    if (json.has("pressure_volume_area_mJ")) {
      json.at("pressure_volume_area_mmHg_mL") >> h.pressure_volume_area_mmHg_mL;
      json.at("pressure_volume_area_mJ") >> h.pressure_volume_area_mJ;
      json.at("arterial_elastance_mmHg_per_mL") >> h.arterial_elastance_mmHg_per_mL;
    }
    for (const auto& [valve_name, valve] : json.at("valves").entries()) {
      ValveVolumes& volumes = h.valves.emplace_back();
      volumes.name = valve_name;
      valve.at("forward_mL") >> volumes.forward_mL;
      valve.at("regurgitant_mL") >> volumes.regurgitant_mL;
      valve.at("regurgitant_percent") >> volumes.regurgitant_percent;
      if (!valve.has("mean_gradient_mmHg")) continue;  // of an earlier version
      valve.at("mean_gradient_mmHg") >> volumes.mean_gradient_mmHg;
      valve.at("peak_gradient_mmHg") >> volumes.peak_gradient_mmHg;
    }
  }
}

void read_balances(const Reader& reader, BeatResult& r) {
  for (const auto& [name, json] : reader.entries()) {
    FlowBalance& balance = r.balances.emplace_back();
    balance.name = name;
    json.at("mean_inflow_mL_per_s") >> balance.mean_inflow_mL_per_s;
    json.at("mean_outflow_mL_per_s") >> balance.mean_outflow_mL_per_s;
    json.at("error_percent") >> balance.error_percent;
  }
}

void read_timing(const Reader& reader, SolveCost& c) {
  reader.at("residuals") >> c.residuals;
  reader.at("factorisations") >> c.factorisations;
  reader.at("linear_solves") >> c.linear_solves;
  reader.at("error_test_failures") >> c.error_test_failures;
  reader.at("convergence_failures") >> c.convergence_failures;
  reader.at("filling_s") >> c.filling_s;
  reader.at("residual_s") >> c.residual_s;
  reader.at("tangent_s") >> c.tangent_s;
  reader.at("factorisation_s") >> c.factorisation_s;
  reader.at("linear_solve_s") >> c.linear_solve_s;
}

void read_global(const Reader& reader, GlobalStrain& strain) {
  for (const GlobalColumn& quantity : kGlobalStrain) reader.at(quantity.key) >> quantity.value(strain);
}

void read_unloading(const Reader& reader, UnloadingResult& u) {
  reader.at("method") >> u.method;
  reader.at("inflations") >> u.inflations;
  reader.at("distance_mm") >> u.distance_mm;
  reader.at("mean_distance_mm") >> u.mean_distance_mm;
  reader.at("longest_way_mm") >> u.longest_way_mm;
  reader.at("wall_time_s") >> u.wall_time_s;
  for (const auto& [name, json] : reader.at("cavities").entries()) {
    UnloadedCavity& c = u.cavities.emplace_back();
    c.name = name;
    json.at("pressure_mmHg") >> c.pressure_mmHg;
    json.at("imaged_mL") >> c.imaged_mL;
    json.at("unloaded_mL") >> c.unloaded_mL;
    json.at("reloaded_mL") >> c.reloaded_mL;
    for (const Reader& p : json.at("filling_mmHg").items()) p >> c.pressures_mmHg.emplace_back();
    for (const Reader& V : json.at("filling_mL").items()) V >> c.volumes_mL.emplace_back();
    if (c.pressures_mmHg.size() != c.volumes_mL.size())
      json.fail("as many filling_mmHg as filling_mL", "lists of different lengths");
  }
}

void read_lists(const Reader& reader, BeatResult& r) {
  for (const Reader& json : reader.at("estimated_errors").items()) {
    EstimatedError& e = r.estimated_errors.emplace_back();
    json.at("instant") >> e.instant;
    json.at("displacement_error_percent") >> e.displacement_percent;
  }
  for (const Reader& json : reader.at("verification").items()) {
    VerificationInstant& v = r.verification.emplace_back();
    json.at("instant") >> v.instant;
    json.at("time_ms") >> v.time_ms;
    json.at("displacement_error_percent") >> v.displacement_error_percent;
    json.at("volume_error_percent") >> v.volume_error_percent;
    json.at("max_segment_strain_error") >> v.max_segment_strain_error;
    json.at("wall_time_s") >> v.wall_time_s;
  }
  for (const Reader& json : reader.at("segments").items()) {
    SegmentInfo& s = r.segments.emplace_back();
    json.at("number") >> s.number;
    json.at("name") >> s.name;
    json.at("volume_mL") >> s.volume_mL;
    json.at("activation_ms") >> s.activation_ms;
  }
  for (const Reader& json : reader.at("plan").items()) {
    PlanItem& item = r.plan.emplace_back();
    json.at("part") >> item.part;
    json.at("built") >> item.built;
    json.at("why") >> item.why;
  }
  for (const Reader& json : reader.at("warnings").items()) json >> r.warnings.emplace_back();
}

}  // namespace

StoredResult parse_summary(const std::string& text, const std::filesystem::path& file) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& error) {
    throw InputError(file.string() + ": not valid JSON, " + error.what());
  }
  const Reader reader(json, "", file.string());
  StoredResult stored;
  BeatResult& r = stored.result;
  reader.at("version") >> stored.info.version;
  reader.at("seed") >> stored.info.seed;
  stored.info.protocol_json = reader.at("protocol").dump();
  reader.at("completed") >> r.completed;
  reader.at("stop_reason") >> r.stop_reason;
  reader.at("method") >> r.method;
  reader.at("has_beat") >> r.has_beat;
  reader.at("has_contraction") >> r.has_contraction;
  reader.at("mesh").at("vertices") >> r.mesh_vertices;
  reader.at("mesh").at("tets") >> r.mesh_tets;
  reader.at("dofs") >> r.dofs;
  reader.at("control_nodes") >> r.control_nodes;
  reader.at("integration_points") >> r.integration_points;
  reader.at("beats") >> r.beats;
  reader.at("time_steps") >> r.time_steps;
  reader.at("newton_iterations") >> r.newton_iterations;
  reader.at("simulated_time_s") >> r.simulated_time_s;
  reader.at("wall_time_s").at("setup") >> r.wall_setup_s;
  reader.at("wall_time_s").at("solve") >> r.wall_solve_s;
  reader.at("wall_time_s").at("output") >> r.wall_output_s;
  reader.at("wall_time_s").at("total") >> r.wall_total_s;
  if (r.has_beat) read_timing(reader.at("timing"), r.cost);
  read_ventricles(reader.at("ventricles"), r);
  read_haemodynamics(reader.at("haemodynamics"), r);
  if (reader.has("flow_balances")) read_balances(reader.at("flow_balances"), r);
  read_global(reader.at("strain"), r.strain);
  if (reader.has("right_strain")) read_global(reader.at("right_strain"), r.right_strain.emplace());
  reader.at("min_det_F") >> r.min_det_F;
  reader.at("max_det_F") >> r.max_det_F;
  if (reader.has("unloading")) read_unloading(reader.at("unloading"), r.unloading.emplace());
  read_lists(reader, r);
  return stored;
}

}  // namespace cardiac
