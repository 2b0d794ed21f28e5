#include <cardiac/bench/beat_scene.hpp>
#include <cardiac/run/build_ventricle.hpp>

#include <algorithm>
#include <cmath>

#include <cardiac/protocol/names.hpp>
#include <cardiac/report/tables.hpp>
#include <cardiac/run/result.hpp>
#include <cardiac/strain/peaks.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/single_thread.hpp>

namespace cardiac {
namespace {

struct Beat {
  Protocol protocol;
  Ventricle ventricle;
  HeartPath path;
  BeatResult result;
  polyaffine::Vector end_systole;
  double setup_s = 0, solve_s = 0;
};

Beat run(const BeatContext& context, const std::shared_ptr<const Anatomy>& anatomy,
         const std::vector<std::string>& settings) {
  Beat out;
  const double start = polyaffine::processor_seconds();
  out.protocol = context.protocol(settings);
  out.ventricle = build_ventricle(anatomy, out.protocol, out.protocol.reduction.method);
  const double built = polyaffine::processor_seconds();
  out.path = run_beats(out.ventricle, out.protocol, {.progress = context.progress});
  out.solve_s = polyaffine::processor_seconds() - built;
  out.setup_s = built - start;
  if (!out.path.completed) return out;
  out.result = describe_path(out.ventricle, segment_nodes(*anatomy, out.protocol), out.protocol, out.path);
  out.end_systole = key_states(out.path, out.protocol).es.c;
  return out;
}

std::vector<SegmentPeaks> peaks(const BeatResult& result) {
  const auto [ed_ms, es_ms] = cardiac_times(result);
  return strain_peaks(result.instants, ed_ms, es_ms);
}

BeatErrors beat_errors(const Beat& reference, const Beat& beat) {
  BeatErrors out;
  out.ef_points = beat.result.ventricles[0].ef_percent - reference.result.ventricles[0].ef_percent;
  out.gls_points = beat.result.strain.gls_percent - reference.result.strain.gls_percent;
  const auto a = peaks(reference.result), b = peaks(beat.result);
  for (std::size_t s = 0; s < a.size(); ++s) {
    double& worst = s + 1 == kAhaSegments ? out.apex_peak_strain : out.peak_strain;
    for (const auto strain :
         {&SegmentPeaks::longitudinal, &SegmentPeaks::circumferential, &SegmentPeaks::radial})
      worst = std::max(worst, std::abs((a[s].*strain).value - (b[s].*strain).value));
  }
  out.real_time_factor = 1000 * beat.solve_s / beat.path.simulated_ms;
  return out;
}

BenchRow make_row(const Beat& reference, const Beat& beat, const Yardstick& yardstick) {
  const bool reduced = beat.ventricle.discretisation.frame_basis != nullptr;
  BenchRow row;
  row.scene = kBeat;
  row.method = reduced ? "polyaffine" : "fem_p2";
  if (reduced) {
    row.preset = protocol::name_of(beat.protocol.reduction.preset);
    row.integration = protocol::name_of(beat.protocol.reduction.integration);
    row.control_nodes = beat.ventricle.discretisation.layout.num_nodes();
  }
  row.mesh_tets = beat.ventricle.anatomy->mesh.num_tets();
  row.dofs = beat.ventricle.discretisation.num_unknowns;
  row.integration_points = beat.ventricle.wall->table().num_points();
  row.setup_s = beat.setup_s;
  row.solve_s = beat.solve_s;
  row.load_steps = beat.path.time_steps;
  row.newton_iterations = beat.path.newton_iterations;
  row.converged = beat.path.completed;
  if (!row.converged) return row;
  const polyaffine::Vector rest = polyaffine::Vector::Zero(beat.ventricle.num_coefficients());
  row.cavity_ratio = beat.ventricle.cavity_volume(beat.end_systole) / beat.ventricle.cavity_volume(rest);
  row.errors = yardstick.errors(beat.ventricle, beat.end_systole);
  row.beat = beat_errors(reference, beat);
  row.speedup_over_fem = reference.solve_s / beat.solve_s;
  return row;
}

}  // namespace

SceneResult run_beat_scene(const BeatContext& context) {
  const polyaffine::SingleThread single_thread;
  const std::vector<std::string> full{"reduction.method=fem", "reduction.element_order=2"};
  const auto anatomy = std::make_shared<const Anatomy>(context.anatomy(context.protocol(full)));
  const Beat reference = run(context, anatomy, full);
  if (!reference.path.completed)
    throw polyaffine::ComputationError("bench: the full-order beat " + reference.path.stop_reason);
  const Yardstick yardstick(reference.ventricle, reference.end_systole);
  SceneResult out{kBeat, "A beat", "", {}};
  const auto add = [&](const BenchRow& row) {
    out.rows.push_back(row);
    context.on_row(row);
  };
  add(make_row(reference, reference, yardstick));
  for (const char* preset : {"fast", "accurate"}) {
    std::vector<std::string> settings{"reduction.method=polyaffine",
                                      std::string("reduction.preset=") + preset};
    settings.insert(settings.end(), context.settings.begin(), context.settings.end());
    add(make_row(reference, run(context, anatomy, settings), yardstick));
  }
  const BenchRow& first = out.rows.front();
  out.reference = first.method + " on " + std::to_string(first.mesh_tets) + " tets, " +
                  std::to_string(first.dofs) + " unknowns";
  return out;
}

}  // namespace cardiac
