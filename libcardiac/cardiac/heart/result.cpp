#include "cardiac/heart/result.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include <cardiac/core/units.hpp>
#include <cardiac/heart/axes_check.hpp>
#include <cardiac/heart/reduced_points.hpp>
#include <cardiac/strain/affine_parameters.hpp>
#include <cardiac/strain/segment_strain.hpp>

namespace cardiac {

using polyaffine::Matrix;
using polyaffine::Points;
using polyaffine::Vector;

namespace {

// Muscle keeps its volume within some per cent; a reduced wall within tens, at its worst point.
constexpr double kCrushed = 0.5;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

VentricleSummary summarise(const HeartPath& path, const KeySteps& key, bool right, bool has_beat) {
  const auto volume_mL = [right](const HeartState& s) {
    return (right ? s.right_volume_mm3 : s.volume_mm3) / mm3_per_mL;
  };
  const auto pressure_mmHg = [right](const HeartState& s) {
    return (right ? s.right_pressure_kPa : s.pressure_kPa) / kPa_per_mmHg;
  };
  VentricleSummary out;
  out.name = right ? "rv" : "lv";
  out.peak_pressure_mmHg = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < path.steps.size(); ++k) {
    const HeartState& s = path.steps[k];
    out.peak_pressure_mmHg = std::max(out.peak_pressure_mmHg, pressure_mmHg(s));
    out.samples.push_back(
        {s.time_ms, volume_mL(s), pressure_mmHg(s), key.phases.empty() ? Phase::filling : key.phases[k]});
  }
  out.edv_mL = out.esv_mL = out.sv_mL = out.ef_percent = out.edp_mmHg = kNone;
  out.ed_time_ms = path.steps[key.ed].time_ms;
  out.es_time_ms = path.steps[key.es].time_ms;
  if (!has_beat) return out;
  out.edv_mL = volume_mL(path.steps[key.ed]);
  out.esv_mL = volume_mL(path.steps[key.es]);
  out.sv_mL = out.edv_mL - out.esv_mL;
  out.ef_percent = 100 * out.sv_mL / out.edv_mL;
  out.edp_mmHg = pressure_mmHg(path.steps[key.ed]);
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

std::vector<Phase> phases(const HeartPath& path, const protocol::Circulation& circulation, bool right) {
  const auto n = static_cast<Eigen::Index>(path.steps.size());
  Vector before(n), pressure(n), behind(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const HeartState& s = path.steps[k];
    pressure[k] = right ? s.right_pressure_kPa : s.pressure_kPa;
    behind[k] = right ? s.loop[0] : s.capacitor_pressure_kPa;
    if (s.loop.size() > 0) before[k] = right ? s.loop[2] : s.loop[1];
  }
  if (path.steps.front().loop.size() == 0)
    return classify_phases(left_heart_loop(circulation), pressure, behind);
  const TwoSidedLoop loop = two_sided_loop(circulation);
  const auto& side = right ? loop.right : loop.left;
  return classify_phases(side.inlet, side.outlet, before, pressure, behind);
}

KeySteps find_key_steps(const HeartPath& path, const Protocol& protocol, bool right) {
  KeySteps out;
  if (path.steps.empty()) return out;
  out.es = path.steps.size() - 1;
  if (!protocol.circulation) return out;
  out.phases = phases(path, *protocol.circulation, right);
  for (std::size_t k = 1; k < out.phases.size(); ++k) {
    if (out.phases[k] == Phase::isovolumetric_contraction && out.phases[k - 1] == Phase::filling)
      out.ed = k - 1;
    if (out.phases[k] != Phase::ejection && out.phases[k - 1] == Phase::ejection) out.es = k - 1;
  }
  return out;
}

// Least det F of 9 × points deformation gradients.
double least_determinant(const Matrix& F) {
  double out = 1;
  for (const auto& at : F.colwise()) out = std::min(out, polyaffine::Mat3(at.reshaped(3, 3)).determinant());
  return out;
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

}  // namespace

KeySteps key_steps(const HeartPath& path, const Protocol& protocol) {
  return find_key_steps(path, protocol, false);
}

KeySteps right_key_steps(const HeartPath& path, const Protocol& protocol) {
  return find_key_steps(path, protocol, true);
}

std::vector<ControlNode> segment_nodes(const Anatomy& anatomy, const Protocol& protocol) {
  FrameLayout layout = protocol_layout(anatomy, protocol);
  if (!layout.follows_segments) layout = frame_layout(anatomy.mesh, *anatomy.coordinates);
  return control_nodes(anatomy.mesh, *anatomy.coordinates, layout);
}

BeatResult describe_path(const Ventricle& ventricle, const std::vector<ControlNode>& nodes,
                         const Protocol& protocol, const HeartPath& path) {
  BeatResult out;
  const Anatomy& anatomy = *ventricle.anatomy;
  const auto& d = ventricle.discretisation;
  out.method = d.sparse ? "fem" : "polyaffine";
  out.has_beat = protocol.circulation.has_value();
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
  if (d.frames) axes_of(anatomy, protocol, out.warnings);
  // A trained rule keeps forces and volumes; means over segments are those of all points.
  const Ventricle& told = ventricle.all_points ? *ventricle.all_points : ventricle;
  out.segments = segment_info(told);
  if (path.steps.empty()) {
    warn_of_crushing(d.sparse, out);
    return out;
  }

  const KeySteps key = key_steps(path, protocol);
  out.ventricles.push_back(summarise(path, key, false, out.has_beat));
  if (ventricle.right_cavity)
    out.ventricles.push_back(summarise(path, right_key_steps(path, protocol), true, out.has_beat));
  const polyaffine::WallPoints points = strain_points(anatomy, d);
  const polyaffine::FieldTable table = polyaffine::deformation_table(*d.basis, points);
  const SegmentGauge gauge(*anatomy.coordinates, points);
  const polyaffine::DisplacementMap displacement(*d.basis, points.tet, points.barycentric);
  const auto positions = [&](const Vector& c) { return Points(gauge.positions() + displacement.apply(c)); };
  const auto gradients = [&](const Vector& c) { return polyaffine::evaluate_field(table, c); };
  const auto* frames = d.layout.follows_segments ? d.frame_basis.get() : nullptr;

  const Matrix F_ed = gradients(path.steps[key.ed].c);
  for (const HeartState& state : path.outputs) {
    const Matrix F = gradients(state.c);
    out.min_det_F = std::min(out.min_det_F, least_determinant(F));
    Instant instant{state.time_ms, gauge.strain(F, F_ed), {}};
    instant.frames =
        frames ? affine_parameters(*frames, nodes, state.c)
               : fit_affine(nodes, gauge.segment(), gauge.positions(), positions(state.c), gauge.weights());
    out.instants.push_back(std::move(instant));
  }
  warn_of_crushing(d.sparse, out);
  std::vector<double> volumes;
  for (const auto& s : out.segments) volumes.push_back(s.volume_mL);
  out.strain = global_strain(
      gauge.strain(gradients(path.steps[key.es].c), F_ed),
      gauge.rotation_deg(positions(path.steps[key.es].c), positions(path.steps[key.ed].c)), volumes);
  return out;
}

}  // namespace cardiac
