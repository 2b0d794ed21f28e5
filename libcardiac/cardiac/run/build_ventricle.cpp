#include "cardiac/run/build_ventricle.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include <cardiac/model/rest_check.hpp>
#include <cardiac/run/key_states.hpp>
#include <cardiac/run/tuned_model.hpp>
#include <cardiac/scene/presets.hpp>
#include <cardiac/training/trained_rule.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {

namespace {

Ventricle tuned_ventricle(const std::shared_ptr<const Anatomy>& anatomy, const Scene& scene,
                          const RunControl& control) {
  const auto model = tuned_model(anatomy, scene, control);
  Ventricle out = assemble_ventricle(anatomy, scene, tuned_discretisation(*anatomy, scene, *model));
  check_rest(out, scene);
  out.tuned = model;
  return out;
}

}  // namespace

Ventricle build_ventricle(std::shared_ptr<const Anatomy> anatomy, const Scene& scene, scene::Method method,
                          const RunControl& control) {
  if (method == scene::Method::polyaffine && is_tuned(scene)) return tuned_ventricle(anatomy, scene, control);
  Ventricle all = assemble_ventricle(anatomy, scene, discretise(anatomy, scene, method));
  if (method == scene::Method::polyaffine) check_rest(all, scene);
  if (method == scene::Method::fem || scene.reduction.integration != scene::Integration::trained) return all;
  if (all.cavities.size() > 1)
    throw polyaffine::InputError(
        "reduction.integration: found trained on a mesh with two ventricles, expected cells or gauss");
  const TrainedRule rule = cached_rule(anatomy, scene);
  Ventricle out = assemble_ventricle(anatomy, scene, with_rule(all.discretisation, rule));
  out.built = all.built;
  out.all_points = std::make_shared<const Ventricle>(std::move(all));
  return out;
}

double rule_error(const Ventricle& ventricle, const Scene& scene, const HeartPath& path) {
  const KeyStates key = key_states(path, scene);
  double worst = 0;
  for (const HeartState* state : {scene.circulation ? &key.ed : &key.es, &key.es})
    worst = std::max(worst, rule_error(ventricle, *state, path.beat_start_ms + state->time_ms));
  return worst;
}

std::string distrust(const Ventricle& ventricle, const Scene& scene, const HeartPath& path) {
  if (!ventricle.all_points) return "";
  if (!path.completed) return "with the trained integration points the run " + path.stop_reason;
  const double error = rule_error(ventricle, scene, path);
  if (error <= kTrustedRuleError) return "";
  std::ostringstream out;
  out << std::setprecision(2) << "the trained integration points are " << 100 * error
      << " % off in displacement, more than " << 100 * kTrustedRuleError << " %";
  return out.str();
}

}  // namespace cardiac
