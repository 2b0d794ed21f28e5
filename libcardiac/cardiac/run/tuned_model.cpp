#include "cardiac/run/tuned_model.hpp"

#include <iomanip>
#include <sstream>
#include <utility>

#include <cardiac/reduction/axes_check.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/run/key_states.hpp>
#include <cardiac/run/statics.hpp>
#include <cardiac/run/tuning_plan.hpp>
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

std::shared_ptr<const TunedModel> tuned_model(const std::shared_ptr<const Anatomy>& anatomy,
                                              const Scene& scene, const RunControl& control) {
  if (scene.tuned) return scene.tuned;
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
  if (out.reached) keep_model(*anatomy, scene, out);  // one that did not, a larger budget may better
  return std::make_shared<const TunedModel>(std::move(out));
}

std::vector<std::string> tuned_warnings(const TunedModel& model, const Scene& scene, const HeartPath& path) {
  std::vector<std::string> out;
  const TuningRound& last = model.rounds.back();
  if (!model.reached)
    out.push_back("reduction.accuracy_percent: the tuned model is " + percent(last.displacement_percent) +
                  " of displacement off in the worst load held out (" + last.worst + "), asked were " +
                  percent(scene.reduction.accuracy_percent) + "; more time (reduction.budget_s) may do");
  if (path.steps.empty()) return out;
  const KeyStates key = key_states(path, scene);
  for (const auto& [name, state] : {std::pair{"end diastole", &key.ed}, std::pair{"end systole", &key.es}})
    if (const double share = 100 * outside(model, state->c); share > scene.reduction.accuracy_percent)
      out.push_back(
          "at " + std::string(name) + " the wall is " + percent(share) +
          " outside of what the tuned model learned from: its error may be several times that of its "
          "training; tune it for this protocol (cardiac reduce), or --verify");
  return out;
}

}  // namespace cardiac
