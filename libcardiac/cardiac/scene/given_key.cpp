#include "cardiac/scene/given_key.hpp"

#include <nlohmann/json.hpp>

#include <cardiac/activation/activation.hpp>
#include <cardiac/circulation/network.hpp>
#include <cardiac/core/given_curve.hpp>

namespace cardiac {

std::string given_key(const Scene& scene) {
  nlohmann::json key;
  const auto text = [&] { return key.is_null() ? std::string() : key.dump(); };
  const auto samples = [&](const GivenCurve& curve) {
    constexpr int kSamples = 200;
    std::vector<double> out{curve.begin_ms, curve.end_ms, curve.repeats ? 1.0 : 0.0};
    for (int i = 0; i <= kSamples; ++i)
      out.push_back(curve.at(curve.begin_ms + curve.period_ms() * i / kSamples).first);
    return out;
  };
  if (scene.cavities && scene.cavities->curves)
    for (const GivenCurve& curve : scene.cavities->curves->curves) {
      key["given"].push_back(samples(curve));
      key["given"].push_back(scene.cavities->curves->are_volumes);
    }
  if (scene.contraction && scene.contraction->tension) key["tension"] = samples(*scene.contraction->tension);
  if (scene.activation && scene.activation->map) {
    const ActivationMap& map = *scene.activation->map;
    key["times"] = {map.points.size(), map.points.sum(), map.points.squaredNorm(), map.times_ms.sum(),
                    map.times_ms.squaredNorm()};
  }
  if (!scene.circulation || scene.circulation->loop == scene::Loop::windkessel) return text();
  key["loop"] = scene.circulation->loop;
  if (!scene.circulation->network) return text();
  for (const Compartment& c : scene.circulation->network->compartments)
    key["compartments"].push_back({c.name, c.type, c.compliance_mm3_per_kPa, c.pressure_kPa,
                                   c.chamber.elastance.active_kPa_per_mm3,
                                   c.chamber.elastance.passive_kPa_per_mm3, c.initial_volume_mm3});
  for (const Element& e : scene.circulation->network->elements)
    key["elements"].push_back({e.name, e.from, e.to, e.type, e.valve.resistance_kPa_ms_per_mm3,
                               e.valve.stenosis_kPa_ms2_per_mm6, e.inertance_kPa_ms2_per_mm3, e.head_kPa});
  return text();
}

}  // namespace cardiac
