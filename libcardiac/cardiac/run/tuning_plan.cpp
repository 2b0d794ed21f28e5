#include "cardiac/run/tuning_plan.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include <cardiac/run/key_states.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {

namespace {

constexpr int kInstants = 8;
constexpr int kRandomLoads = 2;  // of each of two states, held out in a round
constexpr const char* kFilled = "end diastole";
constexpr const char* kEmptied = "end systole";
constexpr const char* kNearTheEnd = "near the end";  // of a load that rises
// Of a segment: tension and stiffness far enough to be seen beside the state, near enough to be linear, and
// the tension of a scar. A scar of two segments is 10.7 % off after linear answers alone, 7 % after those to
// kScar; after these alone the median of walls whose segments differ by less is 1.9 instead of 1.4 % off.
constexpr double kWeak = 0.4, kStiff = 2, kScar = 0.2;

TrainingLoad load_at(const std::string& name, const HeartState& state, double beat_start_ms,
                     double pressure = 1, double level = 1) {
  TrainingLoad out;
  out.name = name;
  out.pressures_kPa = pressure * state.pressures_kPa;
  out.clock_ms = beat_start_ms + state.time_ms;
  out.level = level;
  return out;
}

std::string at_time(const HeartState& state) {
  return std::to_string(static_cast<int>(std::lround(state.time_ms))) + " ms";
}

// The states that divide a path evenly, by how far it has come in pressure, volume and tension over their
// ranges; `shift` (0 to 1) moves them all by a share of their distance.
std::vector<const HeartState*> even_instants(const HeartPath& path, const Ventricle& ventricle, int count,
                                             double shift) {
  const auto tension = [&](const HeartState& s) {
    return ventricle.contraction ? ventricle.contraction->tension(path.beat_start_ms + s.time_ms).mean() : 0;
  };
  double pressure = 0, volume = 0, most = 0, least = 1e300;
  for (const HeartState& s : path.steps) {
    if (s.pressures_kPa.size() > 0) pressure = std::max(pressure, std::abs(s.pressures_kPa[0]));
    if (s.volumes_mm3.size() > 0) volume = std::max(volume, s.volumes_mm3[0]);
    most = std::max(most, tension(s));
    least = std::min(least, tension(s));
  }
  std::vector<double> way{0};
  for (std::size_t k = 1; k < path.steps.size(); ++k) {
    const HeartState &a = path.steps[k - 1], &b = path.steps[k];
    double step = std::abs(tension(b) - tension(a)) / std::max(most - least, 1e-9);
    if (a.pressures_kPa.size() > 0)
      step += std::abs(b.pressures_kPa[0] - a.pressures_kPa[0]) / std::max(pressure, 1e-9);
    if (a.volumes_mm3.size() > 0)
      step += std::abs(b.volumes_mm3[0] - a.volumes_mm3[0]) / std::max(volume, 1e-9);
    way.push_back(way.back() + step);
  }
  std::vector<const HeartState*> out;
  for (int i = 0; i < count; ++i) {
    const double wanted = way.back() * (i + shift) / count;
    const auto at = std::ranges::lower_bound(way, wanted) - way.begin();
    const HeartState* state = &path.steps[static_cast<std::size_t>(at)];
    if (out.empty() || out.back() != state) out.push_back(state);
  }
  return out;
}

// The same load with the pressure of one cavity times a factor.
TrainingLoad with_cavity(TrainingLoad load, const std::string& name, Eigen::Index cavity, double factor) {
  load.name = name;
  load.pressures_kPa[cavity] *= factor;
  return load;
}

std::vector<scene::RegionOverride> each_segment(int segments, double tension, double stiffness) {
  std::vector<scene::RegionOverride> out;
  for (int s = 1; s <= segments; ++s) {
    scene::RegionOverride region;
    region.segments = {s};
    region.tension_factor = tension;
    region.stiffness_factor = stiffness;
    out.push_back(region);
  }
  return out;
}

TrainingLoad random_segments(TrainingLoad load, int segments, bool contracts, std::mt19937_64& random) {
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  load.regions = each_segment(segments, 1, 1);
  for (scene::RegionOverride& region : load.regions) {
    if (contracts) region.tension_factor = uniform(0.6, 1.2);
    region.stiffness_factor = uniform(0.7, 1.5);
  }
  load.pressures_kPa *= uniform(0.8, 1.2);
  load.name += ", other segments";
  return load;
}

// How segments are changed in a state of the path, as far as linear answers reach and beyond.
void add_changed_segments(const std::string& state, int segments, bool contracts, TuningPlan& plan) {
  if (contracts) {
    plan.far_neighbours.push_back({state, each_segment(segments, kScar, 1)});
    plan.neighbours.push_back({state, each_segment(segments, kWeak, 1)});
  }
  plan.neighbours.push_back({state, each_segment(segments, 1, kStiff)});
}

}  // namespace

TuningPlan tuning_plan(const TrainingLoad& load, const Ventricle& untrained) {
  const bool contracts = untrained.contraction != nullptr;
  const int segments = num_segments(*untrained.anatomy->coordinates);
  const auto share = [load](double pressure, double tension) {
    TrainingLoad out = load;
    out.pressures_kPa *= pressure;
    out.level *= tension;
    std::ostringstream name;
    name << "pressure × " << pressure << ", tension × " << tension;
    out.name = name.str();
    return out;
  };
  TuningPlan out;
  for (const double s : {0.25, 0.5, 0.75, 0.95}) out.path.push_back(share(s, s));
  out.path.back().name = kNearTheEnd;
  out.path.push_back(share(1.1, 1.1));
  if (contracts) {
    out.path.push_back(share(0.8, 1));
    out.path.push_back(share(1, 0.8));
    out.path.push_back(share(1, 1.2));
  }
  add_changed_segments(kNearTheEnd, segments, contracts, out);
  out.held_out = [=](int round) {
    std::mt19937_64 random(static_cast<unsigned>(round) + 1);
    const double between = std::fmod(0.45 + 0.6180339887 * round, 1.0);
    std::vector<TrainingLoad> loads{share(between, between), share(0.95 + 0.1 * between, 1)};
    TrainingLoad end = load;
    end.name = kNearTheEnd;  // what is learned where a load of this name is far off
    for (int k = 0; k < kRandomLoads; ++k) loads.push_back(random_segments(end, segments, contracts, random));
    return loads;
  };
  return out;
}

TuningPlan tuning_plan(const HeartPath& path, const Ventricle& untrained, const Scene& scene) {
  if (path.steps.empty())
    throw polyaffine::ComputationError("tuning: the untrained model made no step to learn from: " +
                                       path.stop_reason);
  const KeyStates key = key_states(path, scene);
  const double begin = path.beat_start_ms;
  const bool contracts = scene.contraction.has_value();
  const int segments = num_segments(*untrained.anatomy->coordinates);
  const HeartState& filled = contracts ? key.ed : key.es;

  TuningPlan out;
  out.path.push_back(load_at(kFilled, filled, begin));
  out.path.push_back(load_at("end diastole, pressure × 0.4", filled, begin, 0.4));
  out.path.push_back(load_at("end diastole, pressure × " + std::string(contracts ? "2" : "1.25"), filled,
                             begin, contracts ? 2 : 1.25));
  for (const HeartState* s : even_instants(path, untrained, kInstants, 0))
    if (s->pressures_kPa.size() == 0 || s->pressures_kPa.norm() > 0)
      out.path.push_back(load_at(at_time(*s), *s, begin));
  if (filled.pressures_kPa.size() > 1) {
    out.path.push_back(with_cavity(out.path.front(), "end diastole, right pressure × 0.3", 1, 0.3));
    out.path.push_back(with_cavity(out.path.front(), "end diastole, left pressure × 0.4", 0, 0.4));
  }
  if (contracts) {
    out.path.push_back(load_at(kEmptied, key.es, begin));
    out.path.push_back(load_at("end systole, pressure and tension × 1.2", key.es, begin, 1.2, 1.2));
    out.path.push_back(load_at("end systole, tension × 1.3", key.es, begin, 1, 1.3));
    if (key.es.pressures_kPa.size() > 1)
      out.path.push_back(
          with_cavity(load_at("", key.es, begin), "end systole, right pressure × 1.5", 1, 1.5));
    add_changed_segments(kEmptied, segments, true, out);
  }
  add_changed_segments(kFilled, segments, false, out);

  out.held_out = [=, states = path.steps](int round) {
    HeartPath again;
    again.steps = states;
    again.beat_start_ms = begin;
    std::mt19937_64 random(static_cast<unsigned>(round) + 1);
    // Never the same from round to round, since what was held out is learned: multiples of the golden ratio.
    const double share = std::fmod(0.45 + 0.6180339887 * round, 1.0);
    std::vector<TrainingLoad> loads;
    for (const HeartState* s : even_instants(again, untrained, 3, share))
      if (s->pressures_kPa.size() == 0 || s->pressures_kPa.norm() > 0)
        loads.push_back(load_at(at_time(*s), *s, begin));
    loads.push_back(load_at("end diastole, other pressure", filled, begin, 0.5 + share));
    for (int k = 0; k < kRandomLoads; ++k) {
      loads.push_back(random_segments(load_at(kFilled, filled, begin), segments, false, random));
      if (contracts)
        loads.push_back(random_segments(load_at(kEmptied, key.es, begin), segments, true, random));
    }
    return loads;
  };
  return out;
}

}  // namespace cardiac
