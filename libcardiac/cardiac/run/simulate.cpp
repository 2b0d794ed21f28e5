#include "cardiac/run/simulate.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <cardiac/reduction/axes_check.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/run/plausibility.hpp>
#include <cardiac/run/statics.hpp>
#include <cardiac/run/tuned_model.hpp>
#include <cardiac/run/unload.hpp>
#include <cardiac/scene/presets.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/core/stopwatch.hpp>

namespace cardiac {
namespace {

HeartPath path_of(const Ventricle& model, const Scene& scene, const RunControl& control) {
  return scene.circulation ? run_beats(model, scene, control) : run_prescribed(model, scene, control);
}

// The path by the model, or by all points where the model's are not to be trusted.
HeartPath trusted_path(Ventricle& model, const Scene& scene, const RunControl& control) {
  HeartPath path = path_of(model, scene, control);
  const std::string reason = stop_wanted(control) ? "" : distrust(model, scene, path);
  if (reason.empty()) return path;
  if (control.on_distrust) control.on_distrust();
  model = Ventricle(*model.all_points);
  RunControl anew = control;
  anew.on_checkpoint = {};  // a run that is taken up again would go on with the trained points
  anew.resume = nullptr;
  path = path_of(model, scene, anew);
  path.warnings.push_back(reason + ": computed with all points");
  return path;
}

}  // namespace

Outcome simulate(const Scene& of, const RunControl& control) {
  if (!of.heart) throw polyaffine::InputError("scene: found no heart, expected a mesh with its anatomy");
  Scene scene = of;
  std::vector<std::string> told_with_the_result;
  fill_presets(scene, axes_of(*scene.heart, scene, told_with_the_result) == scene::Axes::cartesian);
  Outcome out;
  double setup_s = 0, solve_s = 0;
  std::optional<Unloading> unloaded;
  {
    const polyaffine::Stopwatch watch(setup_s);
    if (scene.imaged) {
      unloaded = unload(scene, control);
      scene = unloaded_scene(scene, unloaded->heart);
    }
    out.model = build_ventricle(scene.heart, scene, scene.reduction.method, control);
    out.nodes = segment_nodes(*scene.heart, scene);
  }
  if (control.on_built) control.on_built();
  {
    const polyaffine::Stopwatch watch(solve_s);
    out.path = trusted_path(out.model, scene, control);
  }
  if (control.on_solved) control.on_solved();
  std::vector<EstimatedError> errors;
  if (out.model.tuned) {
    errors = estimated_errors(out.model, scene, out.path);
    for (std::string& text : tuned_warnings(*out.model.tuned, scene, errors))
      out.path.warnings.push_back(std::move(text));
  }
  if (unloaded)
    out.path.warnings.insert(out.path.warnings.begin(), unloaded->warnings.begin(), unloaded->warnings.end());
  out.result = describe_path(out.model, out.nodes, scene, out.path);
  out.result.estimated_errors = std::move(errors);
  if (unloaded) out.result.unloading = std::move(unloaded->result);
  out.result.wall_setup_s = setup_s;
  out.result.wall_solve_s = solve_s;
  refuse_absurdities(out.result, control.keep_absurd);
  return out;
}

}  // namespace cardiac
