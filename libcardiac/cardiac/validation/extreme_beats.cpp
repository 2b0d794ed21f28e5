#include <cardiac/validation/extreme_checks.hpp>

namespace cardiac {
namespace {

// Ejection fraction against full order on the same tets: twice the 1.36 points of the highest tension; the
// other beats stay below one.
constexpr double kMostPoints = 2.7;

struct Between {
  double low, high;
};

// What a change does to a beat: ejection fraction minus that of the plain beat in points, peak pressure over
// it. Where a change must be felt, one of the ranges leaves the plain beat out.
struct BeatVariant {
  std::string name;
  std::vector<std::string> settings;
  Between ef_change, peak_ratio;
  bool quick = false;  // also in the quick set
};

const std::vector<BeatVariant>& variants() {
  static const std::string delayed =
      "region=[{segments=[5, 6, 11, 12, 16], activation_delay_ms=120}, {segments=[4, 10, 15], "
      "activation_delay_ms=60}]";
  static const std::string alone =
      "region=[{segments=[1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17], tension_factor=0}]";
  static const auto sudden = [](const std::string& tension) {
    return std::vector<std::string>{"contraction.contractility_kPa=" + tension,
                                    "contraction.activation_rate_per_s=5000",
                                    "contraction.switch_width_ms=0.2"};
  };
  static const auto valves = [](const std::string& resistance) {
    return std::vector<std::string>{"circulation.mitral_resistance_mmHg_s_per_mL=" + resistance,
                                    "circulation.aortic_valve_resistance_mmHg_s_per_mL=" + resistance};
  };
  static const auto wide_open = [](const std::string& resistance) {
    auto out = valves(resistance);
    out.emplace_back("circulation.characteristic_resistance_mmHg_s_per_mL=0");
    return out;
  };
  static const std::vector<BeatVariant> list{
      {"tension_0_kPa", {"contraction.contractility_kPa=0"}, {-70, -40}, {0, 0.5}},
      {"tension_60_kPa_within_1_ms", sudden("60"), {-40, -2}, {0.5, 1.5}},
      {"tension_300_kPa_within_1_ms", sudden("300"), {3, 30}, {1.05, 10}, true},
      {"tension_in_one_segment", {alone}, {-70, -30}, {0, 0.7}},
      {"left_bundle_branch_block", {delayed}, {-20, -0.5}, {0.7, 1}, true},
      {"rate_30", {"time.heart_rate_bpm=30"}, {-5, 15}, {0.6, 1.2}},
      {"rate_120",
       {"time.heart_rate_bpm=120", "activation.onset_ms=50", "contraction.activation_duration_ms=220"},
       {-40, -1},
       {0.6, 1.2}},
      {"rate_220",
       {"time.heart_rate_bpm=220", "activation.onset_ms=20", "contraction.activation_duration_ms=120",
        "time.max_beats=3"},
       {-60, -5},
       {0.4, 1.2},
       true},
      {"valves_1e-6", wide_open("1e-6"), {-5, 10}, {0.6, 0.97}, true},
      {"valves_1e-4", wide_open("1e-4"), {-5, 10}, {0.6, 0.97}},
      {"valves_1", valves("1"), {-50, -5}, {1, 3}},
      {"valves_100", valves("100"), {-70, -40}, {1, 4}},
      {"compliance_1e-6", {"circulation.compliance_mL_per_mmHg=1e-6"}, {-40, -1}, {1.05, 3}, true},
      {"compliance_1e-2", {"circulation.compliance_mL_per_mmHg=1e-2"}, {-40, -1}, {1.05, 3}},
      {"compliance_1e4", {"circulation.compliance_mL_per_mmHg=1e4"}, {0, 20}, {0.5, 0.97}},
      {"cartesian_axes", {"reduction.axes=cartesian"}, {-3, 3}, {0.95, 1.05}},
      {"activated_from_the_septum",
       {"activation.mode=sites", "activation.site_segments=[9]"},
       {-20, -0.5},
       {0.6, 1},
       true},
      {"aortic_stenosis", {"circulation.aortic_valve_resistance_mmHg_s_per_mL=0.5"}, {-40, -3}, {1.1, 3}},
      {"aortic_regurgitation",
       {"circulation.aortic_leak_resistance_mmHg_s_per_mL=0.3"},
       {0.5, 20},
       {0.6, 1.1}},
  };
  return list;
}

void beats(ExtremeChecks& checks, bool fem, std::vector<double>& ef) {
  const ExtremeMesh& wall = checks.wall();
  const auto run = [&](const std::string& name, const std::vector<std::string>& settings) {
    auto outcome = checks.run("beats/" + name, wall, kExtremeBeat, fem ? full_order(settings) : settings);
    checks.expect(outcome, "min_det_F", "1", outcome.path.min_det_F, {1, 0.05, 1, "the wall stays a wall"});
    ef.push_back(outcome.ef_percent());
    return outcome;
  };
  const auto plain = run("plain", {});
  checks.expect(plain, "ef_percent", "%", plain.ef_percent(), {60, 50, 70, "a healthy heart"});
  checks.expect(plain, "peak_mmHg", "mmHg", plain.peak_pressure_mmHg(), {120, 90, 150, "a healthy heart"});
  for (const BeatVariant& variant : variants()) {
    if (checks.quick() && !variant.quick) continue;
    const auto outcome = run(variant.name, variant.settings);
    const auto& [ef_low, ef_high] = variant.ef_change;
    const auto& [peak_low, peak_high] = variant.peak_ratio;
    checks.expect(outcome, "ef_minus_plain", "points", outcome.ef_percent() - plain.ef_percent(),
                  {(ef_low + ef_high) / 2, ef_low, ef_high, "what the change does to ejection"});
    checks.expect(outcome, "peak_over_plain", "1", outcome.peak_pressure_mmHg() / plain.peak_pressure_mmHg(),
                  {(peak_low + peak_high) / 2, peak_low, peak_high, "what the change does to pressure"});
  }
}

}  // namespace

void extreme_beats(ExtremeChecks& checks) {
  std::vector<double> ef, ef_full;
  beats(checks, false, ef);
  if (checks.quick()) return;
  beats(checks, true, ef_full);
  for (std::size_t k = 0; k < ef.size(); ++k)
    checks.add({.case_name = "extreme/beats/" + (k == 0 ? "plain" : variants()[k - 1].name),
                .method = "polyaffine against fem_p2, 396 tets",
                .quantity = "ef_minus_full_order",
                .unit = "points",
                .value = ef[k] - ef_full[k],
                .reference = 0,
                .low = -kMostPoints,
                .high = kMostPoints,
                .source = "full order on the same mesh"});
}

}  // namespace cardiac
