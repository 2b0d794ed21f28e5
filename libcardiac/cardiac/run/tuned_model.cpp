#include "cardiac/run/tuned_model.hpp"

#include <iomanip>
#include <sstream>
#include <utility>

#include <cardiac/reduction/axes_check.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/run/key_states.hpp>
#include <cardiac/run/statics.hpp>
#include <cardiac/run/tuning_plan.hpp>
#include <cardiac/scene/contraction_time.hpp>
#include <cardiac/scene/presets.hpp>
#include <cardiac/training/tuned_archive.hpp>

namespace cardiac {
namespace {

// The scene with the fast preset: what it asks is known well enough from that.
Scene untrained(const Anatomy& anatomy, const Scene& scene) {
  Scene out = scene;
  scene::Reduction& r = out.reduction;
  r.preset = scene::Preset::fast;
  r.enrichment.reset();
  r.pressure_space.reset();
  r.border_functions.reset();
  out.time.max_beats = std::min(out.time.max_beats, 3);
  std::vector<std::string> told_with_the_result;
  fill_presets(out, axes_of(anatomy, out, told_with_the_result) == scene::Axes::cartesian);
  return out;
}

std::string percent(double value) {
  std::ostringstream out;
  out << std::setprecision(2) << value << " %";
  return out.str();
}

}  // namespace

std::shared_ptr<const TunedModel> tuned_model(const std::shared_ptr<const Anatomy>& anatomy, const Scene& of,
                                              const RunControl& control) {
  if (of.tuned) return of.tuned;
  const Scene scene = with_twitch(of);  // states to learn from are at rest
  if (auto kept = cached_model(*anatomy, scene)) return std::make_shared<const TunedModel>(std::move(*kept));
  const Scene plain = untrained(*anatomy, scene);
  const Ventricle model = build_ventricle(anatomy, plain, scene::Method::polyaffine);
  RunControl quiet;
  quiet.stop_reason = control.stop_reason;
  const HeartPath path =
      scene.circulation ? run_beats(model, plain, quiet) : run_prescribed(model, plain, quiet);
  TuningControl tuning;
  tuning.accuracy_percent = scene.reduction.accuracy_percent;
  tuning.budget_s = scene.reduction.budget_s;
  tuning.progress = control.progress;
  tuning.on_round = control.on_round;
  tuning.interrupted = [&control] { return stop_wanted(control); };
  TunedModel out = tune(anatomy, scene, tuning_plan(path, model, scene), tuning);
  keep_model(*anatomy, scene, out);
  return std::make_shared<const TunedModel>(std::move(out));
}

std::vector<EstimatedError> estimated_errors(const Ventricle& model, const Scene& scene,
                                             const HeartPath& path) {
  if (path.steps.empty() || model.muscle) return {};
  const TunedModel& tuned = *model.tuned;
  const Ventricle full = build_ventricle(model.anatomy, scene, scene::Method::fem);
  const Ventricle larger =
      assemble_ventricle(model.anatomy, scene, check_discretisation(*model.anatomy, scene, tuned));
  const KeyStates key = key_states(path, scene);
  std::vector<EstimatedError> out;
  for (const auto& [name, at] : {std::pair{"ED", &key.ed}, std::pair{"ES", &key.es}}) {
    NestedState state{{}, at->c, {}};
    state.load.pressures_kPa = at->pressures_kPa;
    state.load.clock_ms = path.beat_start_ms + at->time_ms;
    if (model.wall->pressure_space()) state.pressure = model.wall->pressure(at->c);
    if (const auto error = estimated_error(tuned.check, larger, full, state))
      out.push_back({name, 100 * *error});
  }
  return out;
}

std::vector<std::string> tuned_warnings(const TunedModel& model, const Scene& scene,
                                        const std::vector<EstimatedError>& errors) {
  std::vector<std::string> out;
  const TuningRound& last = model.rounds.back();
  const double accuracy = scene.reduction.accuracy_percent;
  if (!model.reached)
    out.push_back(
        "reduction.accuracy_percent: the tuned model is " + percent(last.protocol.displacement_percent) +
        " of displacement off in the worst load held out, " + percent(last.segments.displacement_percent) +
        " where every segment has changed; asked were " + percent(accuracy) + " and " +
        percent(kSegmentsAllowance * accuracy) + "; more time (reduction.budget_s) may do");
  if (scene.contraction && scene.contraction->feels_fibre())
    out.push_back(
        "the error of the tuned model was not estimated: the tension of contraction.model feels the "
        "fibre, and estimates are of walls at rest");
  for (const EstimatedError& at : errors)
    if (at.displacement_percent > kSegmentsAllowance * accuracy)
      out.push_back(
          "at " + at.instant + " the tuned model is about " + percent(at.displacement_percent) +
          " of displacement off full order, by its own estimate: this is outside of what it learned "
          "from; tune it for this protocol (cardiac reduce), or --verify");
  return out;
}

}  // namespace cardiac
