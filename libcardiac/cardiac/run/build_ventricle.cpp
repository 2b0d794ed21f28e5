#include "cardiac/run/build_ventricle.hpp"

#include <algorithm>

#include <cardiac/model/rest_check.hpp>
#include <cardiac/run/key_states.hpp>
#include <cardiac/training/trained_rule.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {

Ventricle build_ventricle(std::shared_ptr<const Anatomy> anatomy, const Protocol& protocol,
                          protocol::Method method) {
  Ventricle all = assemble_ventricle(anatomy, protocol, discretise(anatomy, protocol, method));
  if (method == protocol::Method::polyaffine) check_rest(all, protocol);
  if (method == protocol::Method::fem || protocol.reduction.integration != protocol::Integration::trained)
    return all;
  if (all.cavities.size() > 1)
    throw polyaffine::InputError(
        "reduction.integration: found trained on a mesh with two ventricles, expected cells or gauss");
  const TrainedRule rule = cached_rule(anatomy, protocol);
  Ventricle out = assemble_ventricle(anatomy, protocol, with_rule(all.discretisation, rule));
  out.built = all.built;
  out.all_points = std::make_shared<const Ventricle>(std::move(all));
  return out;
}

double rule_error(const Ventricle& ventricle, const Protocol& protocol, const HeartPath& path) {
  const KeyStates key = key_states(path, protocol);
  double worst = 0;
  for (const HeartState* state : {protocol.circulation ? &key.ed : &key.es, &key.es})
    worst = std::max(worst, rule_error(ventricle, *state, path.beat_start_ms + state->time_ms));
  return worst;
}

}  // namespace cardiac
