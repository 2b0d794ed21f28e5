#include "cardiac/run/result.hpp"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

#include <cardiac/core/units.hpp>
#include <cardiac/reduction/axes_check.hpp>
#include <cardiac/reduction/frame_functions.hpp>
#include <cardiac/run/energy_balance.hpp>
#include <cardiac/run/haemodynamics.hpp>
#include <cardiac/run/motion.hpp>
#include <cardiac/run/segment_mechanics.hpp>

namespace cardiac {

using polyaffine::Vector;

namespace {

// Muscle keeps its volume within some per cent; a reduced wall within tens, at its worst point.
constexpr double kCrushed = 0.5;
constexpr double kLostEnergy_percent = 2;  // twenty times what the default tolerances leave
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

VentricleSummary summarise(const HeartPath& path, const KeyStates& key, int cavity, const std::string& name,
                           bool has_beat) {
  const auto volume_mL = [cavity](const HeartState& s) { return s.volumes_mm3[cavity] / mm3_per_mL; };
  const auto pressure_mmHg = [cavity](const HeartState& s) { return s.pressures_kPa[cavity] / kPa_per_mmHg; };
  VentricleSummary out;
  out.name = name;
  out.peak_pressure_mmHg = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < path.steps.size(); ++k) {
    const HeartState& s = path.steps[k];
    out.peak_pressure_mmHg = std::max(out.peak_pressure_mmHg, pressure_mmHg(s));
    out.samples.push_back(
        {s.time_ms, volume_mL(s), pressure_mmHg(s), key.phases.empty() ? Phase::filling : key.phases[k]});
  }
  out.edv_mL = out.esv_mL = out.sv_mL = out.ef_percent = out.edp_mmHg = kNone;
  out.ed_time_ms = key.ed.time_ms;
  out.es_time_ms = key.es.time_ms;
  out.ed_is = key.ed_is;
  out.es_is = key.es_is;
  if (!has_beat && !(path.contraction_begins && key.largest_mm3 > 0)) return out;
  out.edv_mL = key.largest_mm3 / mm3_per_mL;
  out.esv_mL = key.smallest_mm3 / mm3_per_mL;
  out.isovolumetric_contraction_change_mL = key.contraction_change_mm3 / mm3_per_mL;
  out.isovolumetric_relaxation_change_mL = key.relaxation_change_mm3 / mm3_per_mL;
  out.sv_mL = out.edv_mL - out.esv_mL;
  out.ef_percent = 100 * out.sv_mL / out.edv_mL;
  out.edp_mmHg = pressure_mmHg(key.ed);
  return out;
}

std::vector<SegmentInfo> segment_info(const Ventricle& ventricle) {
  const Anatomy& anatomy = *ventricle.anatomy;
  const int count = num_segments(*anatomy.coordinates);
  const auto volumes = segment_volumes(anatomy.mesh, anatomy.segment, count);
  std::vector<SegmentInfo> out;
  for (int s = 1; s <= count; ++s) out.push_back({s, aha_name(s), volumes[s - 1] / mm3_per_mL, {}});
  if (!ventricle.contraction) return out;
  Vector time = Vector::Zero(count);
  Vector weight = Vector::Zero(count);
  const auto& points = ventricle.discretisation.points;
  for (std::size_t q = 0; q < points.tet.size(); ++q) {
    const int s = anatomy.segment[points.tet[q]] - 1;
    const auto k = static_cast<Eigen::Index>(q);
    time[s] += points.weights[k] * ventricle.contraction->delay_ms[k];
    weight[s] += points.weights[k];
  }
  for (int s = 0; s < count; ++s)
    if (weight[s] > 0) out[s].activation_ms = time[s] / weight[s];
  return out;
}

void add_motion(const Ventricle& ventricle, const std::vector<ControlNode>& nodes, const Scene& scene,
                const HeartPath& path, const KeyStates& key, BeatResult& out) {
  const Motion motion(ventricle, nodes, out.segments, key.ed.c);
  out.nodes = motion.nodes();
  if (scene.output.frames) out.frame_functions = frame_functions(ventricle.discretisation);
  out.instants = motion.instants(path.outputs);
  for (std::size_t i = 0; i < out.instants.size(); ++i) {
    out.min_det_F = std::min(out.min_det_F, out.instants[i].min_det_F);
    for (std::size_t k = 0; k < out.frame_functions.size(); ++k)
      out.instants[i].frame_unknowns.emplace_back(
          path.outputs[i].c.segment<3>(3 * static_cast<Eigen::Index>(k)));
  }
  if (scene.output.mechanics) {
    auto mechanics = segment_mechanics(ventricle, scene, path, key.ed.c);
    for (std::size_t i = 0; i < out.instants.size(); ++i) out.instants[i].mechanics = std::move(mechanics[i]);
  }
  const Instant es = motion.instants({key.es}).front();
  out.strain = es.global.front();
  if (es.global.size() > 1) out.right_strain = es.global[1];
}

void warn_of_crushing(bool full_order, BeatResult& out) {
  if (out.min_det_F >= kCrushed) return;
  const std::string what = out.min_det_F > 0 ? std::to_string(100 * out.min_det_F) + " % of its volume"
                                             : "nothing, and turned inside out,";
  out.warnings.push_back("the wall was compressed to " + what +
                         " somewhere (min_det_F): the numbers are not those of muscle; "
                         "lower the load, or raise " +
                         (full_order ? "tissue.bulk_modulus_kPa"
                                     : "reduction.local_bulk_modulus_kPa (60 where muscle contracts)"));
}

void warn_of_energy(BeatResult& out) {
  if (!out.energy || out.energy->active_mJ == 0 || !(out.energy->percent() > kLostEnergy_percent)) return;
  std::ostringstream text;
  text << std::setprecision(2) << "the energy of the last beat does not balance: " << out.energy->percent()
       << " % of it is missing (energy_balance_percent); lower time.relative_tolerance and "
          "time.absolute_tolerance_mm";
  out.warnings.push_back(text.str());
}

}  // namespace

std::vector<ControlNode> segment_nodes(const Anatomy& anatomy, const Scene& scene) {
  FrameLayout layout = frame_layout_of(anatomy, scene);
  if (!layout.follows_segments) layout = frame_layout(anatomy.mesh, *anatomy.coordinates);
  return control_nodes(anatomy.mesh, *anatomy.coordinates, layout);
}

BeatResult describe_path(const Ventricle& ventricle, const std::vector<ControlNode>& nodes,
                         const Scene& scene, const HeartPath& path) {
  BeatResult out;
  const Anatomy& anatomy = *ventricle.anatomy;
  const auto& d = ventricle.discretisation;
  out.method = d.sparse ? "fem" : "polyaffine";
  out.has_beat = scene.circulation.has_value();
  out.has_contraction = scene.contraction.has_value();
  out.mesh_vertices = anatomy.mesh.num_points();
  out.mesh_tets = anatomy.mesh.num_tets();
  out.dofs = d.num_unknowns;
  out.control_nodes = d.sparse ? 0 : d.layout.num_nodes();
  out.integration_points = static_cast<int>(d.points.tet.size());
  out.beats = path.beats;
  out.time_steps = path.time_steps;
  out.newton_iterations = path.newton_iterations;
  out.cost = path.cost;
  out.simulated_time_s = path.simulated_ms / ms_per_s;
  out.min_det_F = path.min_det_F;
  out.max_det_F = path.max_det_F;
  out.completed = path.completed;
  out.stop_reason = path.stop_reason;
  out.warnings = path.warnings;
  if (d.frames) {
    axes_of(anatomy, scene, out.warnings);
    for (std::string text : {untrained_warning(anatomy, scene), moving_base_warning(scene)})
      if (!text.empty()) out.warnings.push_back(std::move(text));
  }
  // A trained rule keeps forces and volumes; means over segments are those of all points.
  const Ventricle& told = ventricle.all_points ? *ventricle.all_points : ventricle;
  out.segments = segment_info(told);
  if (path.steps.empty()) {
    warn_of_crushing(d.sparse, out);
    return out;
  }

  const KeyStates key = key_states(path, scene);
  // A wall without a cavity is told as a left ventricle without a volume.
  out.ventricles.push_back(summarise(path, key, 0, "lv", out.has_beat));
  for (int k = 1; k < static_cast<int>(ventricle.cavities.size()); ++k)
    out.ventricles.push_back(summarise(path, key_states(path, scene, k), k,
                                       ventricle.cavities[static_cast<std::size_t>(k)].name, out.has_beat));
  for (int k = 0; k < static_cast<int>(out.ventricles.size()); ++k)
    for (std::string& warning : valve_warnings(path, scene, k)) out.warnings.push_back(std::move(warning));
  if (out.has_beat) {
    for (std::size_t k = 0; k < out.ventricles.size(); ++k)
      out.ventricles[k].haemodynamics = haemodynamics(path, scene, static_cast<int>(k));
    out.circulation = circulation_table(path, scene);
    out.balances = flow_balances(path, scene);
  }
  out.energy = energy_balance(ventricle, scene.time, path);
  if (out.completed) warn_of_energy(out);
  add_motion(ventricle, nodes, scene, path, key, out);
  warn_of_crushing(d.sparse, out);
  return out;
}

}  // namespace cardiac
