#include <cardiac/bench/beat_scene.hpp>

#include <algorithm>
#include <cmath>

#include <cardiac/protocol/names.hpp>
#include <cardiac/report/tables.hpp>
#include <cardiac/run/simulate.hpp>
#include <cardiac/strain/peaks.hpp>
#include <cardiac/training/tuned_model.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/single_thread.hpp>

namespace cardiac {
namespace {

struct Beat {
  scene::Reduction reduction;
  Outcome outcome;
  polyaffine::Vector end_systole;
  double setup_s = 0, solve_s = 0;  // processor time

  const Ventricle& model() const { return outcome.model; }
  const HeartPath& path() const { return outcome.path; }
  const BeatResult& result() const { return outcome.result; }
};

Beat run(const BeatContext& context, const std::shared_ptr<const Anatomy>& anatomy,
         const std::vector<std::string>& settings) {
  Beat out;
  Scene scene = context.protocol(settings);
  scene.heart = anatomy;
  out.reduction = scene.reduction;
  const double start = polyaffine::processor_seconds();
  double built = start, solved = start;
  out.outcome = simulate(scene, {.progress = context.progress,
                                 .on_built = [&] { built = polyaffine::processor_seconds(); },
                                 .on_solved = [&] { solved = polyaffine::processor_seconds(); }});
  out.setup_s = built - start;
  out.solve_s = solved - built;
  if (out.path().completed) out.end_systole = key_states(out.path(), scene).es.c;
  return out;
}

std::vector<SegmentPeaks> peaks(const BeatResult& result) {
  const auto [ed_ms, es_ms] = cardiac_times(result);
  return strain_peaks(result.instants, ed_ms, es_ms);
}

BeatErrors beat_errors(const Beat& reference, const Beat& beat) {
  BeatErrors out;
  out.ef_points = beat.result().ventricles[0].ef_percent - reference.result().ventricles[0].ef_percent;
  out.gls_points = beat.result().strain.gls_percent - reference.result().strain.gls_percent;
  const auto a = peaks(reference.result()), b = peaks(beat.result());
  for (std::size_t s = 0; s < a.size(); ++s) {
    double& worst = s + 1 == kAhaSegments ? out.apex_peak_strain : out.peak_strain;  // the right wall too
    for (const auto strain :
         {&SegmentPeaks::longitudinal, &SegmentPeaks::circumferential, &SegmentPeaks::radial})
      worst = std::max(worst, std::abs((a[s].*strain).value - (b[s].*strain).value));
  }
  out.real_time_factor = 1000 * beat.solve_s / beat.path().simulated_ms;
  return out;
}

BenchRow make_row(const BeatContext& context, const Beat& reference, const Beat& beat,
                  const Yardstick& yardstick) {
  const bool reduced = beat.model().discretisation.frame_basis != nullptr;
  BenchRow row;
  row.scene = context.name;
  row.heart = context.heart;
  row.method = reduced ? "polyaffine" : "fem_p2";
  if (reduced) {
    row.preset = protocol::name_of(beat.reduction.preset);
    row.integration = protocol::name_of(beat.reduction.integration);
    row.control_nodes = beat.model().discretisation.layout.num_nodes();
  }
  row.mesh_tets = beat.model().anatomy->mesh.num_tets();
  row.dofs = beat.model().discretisation.num_unknowns;
  row.integration_points = beat.model().wall->table().num_points();
  // A tuned model may have come from the cache.
  row.setup_s = std::max(beat.setup_s, learning_seconds(beat.model().tuned.get()));
  row.setup_full_order_solves = full_order_solves(beat.model().tuned.get());
  row.solve_s = beat.solve_s;
  row.load_steps = beat.path().time_steps;
  row.newton_iterations = beat.path().newton_iterations;
  row.converged = beat.path().completed;
  if (!row.converged) return row;
  const polyaffine::Vector rest = polyaffine::Vector::Zero(beat.model().num_coefficients());
  row.cavity_ratio = beat.model().cavity_volume(beat.end_systole) / beat.model().cavity_volume(rest);
  row.errors = yardstick.errors(beat.model(), beat.end_systole);
  row.same_tets = row.errors;
  row.beat = beat_errors(reference, beat);
  row.speedup_over_fem = reference.solve_s / beat.solve_s;
  if (reduced && beat.solve_s < reference.solve_s)
    row.break_even_solves =
        beat.setup_s / ((reference.solve_s - beat.solve_s) / static_cast<double>(reference.result().beats));
  return row;
}

}  // namespace

SceneResult run_beat_scene(const BeatContext& context) {
  const polyaffine::SingleThread single_thread;
  const std::vector<std::string> full{"reduction.method=fem", "reduction.element_order=2"};
  const auto anatomy = std::make_shared<const Anatomy>(context.anatomy(context.protocol(full)));
  const Beat reference = run(context, anatomy, full);
  if (!reference.path().completed)
    throw polyaffine::ComputationError("bench: the full-order beat " + reference.path().stop_reason);
  const Yardstick yardstick(reference.model(), reference.end_systole);
  SceneResult out{context.name, context.name == kBeat ? "A beat" : "A beat of two ventricles", "", {}};
  const auto add = [&](const BenchRow& row) {
    out.rows.push_back(row);
    context.on_row(row);
  };
  add(make_row(context, reference, reference, yardstick));
  for (const std::string& preset : context.presets) {
    std::vector<std::string> settings{"reduction.method=polyaffine", "reduction.preset=" + preset};
    settings.insert(settings.end(), context.settings.begin(), context.settings.end());
    add(make_row(context, reference, run(context, anatomy, settings), yardstick));
  }
  const BenchRow& first = out.rows.front();
  out.reference = first.method + " on " + std::to_string(first.mesh_tets) + " tets, " +
                  std::to_string(first.dofs) + " unknowns";
  return out;
}

}  // namespace cardiac
