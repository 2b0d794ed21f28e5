#include <cardiac/scene/contraction_time.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <cardiac/contraction/bestel_full_2001.hpp>
#include <cardiac/contraction/land_2017.hpp>
#include <cardiac/contraction/twitch.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

constexpr double kDuration_ms = 324;        // Aróstica et al. 2025
constexpr double kAtBeat_ms = 800;          // 75 beats a minute
constexpr double kFastest_ms = 1000.0 / 3;  // beats below are of hearts smaller than ours
constexpr double kShortest_ms = 200;        // below, systole is a share of the beat
constexpr double kContractility_kPa = 65;   // that the stiffness of bridges belongs to: Genet et al. 2023
constexpr double kDecay_ms = 50, kRise_ms = 20;  // of calcium: CalciumTransient

// Of calcium, whose times shorten with the beat.
double shortening(const scene::Contraction& contraction, const scene::Time& time) {
  return time_factor(contraction, time) * std::sqrt(std::max(time.beat_ms, kFastest_ms) / kAtBeat_ms);
}

}  // namespace

double time_factor(const scene::Contraction& contraction, const scene::Time& time) {
  return contraction.time_factor.value_or(std::min(1.0, time.beat_ms / kFastest_ms));
}

double activation_duration_ms(const scene::Contraction& contraction, const scene::Time& time) {
  const double beat = std::max(time.beat_ms, kShortest_ms),
               share = std::min(1.0, time.beat_ms / kShortest_ms);
  return contraction.activation_duration_ms.value_or(kDuration_ms * share * std::sqrt(beat / kAtBeat_ms));
}

BestelParameters bestel_parameters(const scene::Contraction& c, const scene::Time& time) {
  const double factor = time_factor(c, time);
  return {c.activation_rate_per_ms / factor, c.relaxation_rate_per_ms / factor, c.contractility_kPa, 0,
          activation_duration_ms(c, time),   c.switch_width_ms * factor};
}

CalciumTimes calcium_times(const scene::Contraction& c, const scene::Time& time) {
  const double shorter = shortening(c, time);
  return {c.calcium_rise_ms.value_or(kRise_ms * shorter), c.calcium_decay_ms.value_or(kDecay_ms * shorter)};
}

std::shared_ptr<const SarcomereModel> sarcomere_model(const scene::Contraction& c, const scene::Time& time) {
  if (c.model == scene::ContractionModel::bestel_clement_sorine) {
    const BridgeParameters bridges;
    const double stiffness = bridges.bridge_stiffness_kPa * c.contractility_kPa / kContractility_kPa;
    return std::make_shared<BestelFull2001>(
        bestel_parameters(c, time),
        BridgeParameters{c.bridge_stiffness_kPa.value_or(stiffness), c.series_stiffness_kPa,
                         c.bridge_viscosity_kPa_ms, c.rate_destruction, c.overlap_slope},
        time.beat_ms);
  }
  LandParameters land;
  land.reference_tension_kPa = c.reference_tension_kPa;
  land.calcium_50_uM = c.calcium_50_uM;
  land.calcium_slope_uM = c.calcium_slope_uM;
  land.overlap_slope = c.overlap_slope;
  land.time_factor = time_factor(c, time);
  const auto [rise_ms, decay_ms] = calcium_times(c, time);
  land.calcium = {.diastolic_uM = c.diastolic_calcium_uM,
                  .peak_uM = c.peak_calcium_uM,
                  .decay_ms = decay_ms,
                  .rise_ms = rise_ms,
                  .period_ms = time.beat_ms,
                  .given = c.calcium};
  return std::make_shared<Land2017>(land);
}

Scene with_twitch(const Scene& scene) {
  if (!scene.contraction || !scene.contraction->feels_fibre()) return scene;
  const auto model = sarcomere_model(*scene.contraction, scene.time);
  constexpr int kSamples = 400;
  constexpr double kLeastTension_kPa = 1e-6;
  Twitch twitch = isometric_twitch(*model, 1, kSamples);
  if (!(twitch.peak_kPa() > kLeastTension_kPa))
    throw polyaffine::InputError("contraction: a fibre that is held makes no tension (" +
                                 std::to_string(twitch.peak_kPa()) +
                                 " kPa at most); expected more calcium, or a longer activation");
  for (double& tension : twitch.tension_kPa) tension = std::max(0.0, tension);
  Scene out = scene;
  out.contraction->model = scene::ContractionModel::table;
  out.contraction->tension = std::make_shared<const GivenCurve>(
      GivenCurve::through(std::move(twitch.times_ms), std::move(twitch.tension_kPa), scene.time.beat_ms));
  return out;
}

}  // namespace cardiac
