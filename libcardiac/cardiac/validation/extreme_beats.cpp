#include <cardiac/validation/extreme_checks.hpp>

namespace cardiac {
namespace {

struct BeatVariant {
  std::string name;
  std::vector<std::string> settings;
  double low = 0, high = 90;  // ejection fraction, %
  bool full_order = false;    // also by full order
  bool quick = false;         // also in the quick set
};

const std::vector<BeatVariant>& variants() {
  static const std::string delayed =
      "region=[{segments=[5, 6, 11, 12, 16], activation_delay_ms=120}, {segments=[4, 10, 15], "
      "activation_delay_ms=60}]";
  static const std::string alone =
      "region=[{segments=[1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17], tension_factor=0}]";
  static const auto sudden = [](const std::string& tension) {
    return std::vector<std::string>{"contraction.contractility_kPa=" + tension,
                                    "contraction.activation_rate_per_s=1000",
                                    "contraction.switch_width_ms=0.5"};
  };
  static const std::vector<BeatVariant> list{
      {"plain", {}, 35, 75, true, true},
      {"tension_0_kPa", {"contraction.contractility_kPa=0"}, 0, 10},
      {"tension_60_kPa_within_1_ms", sudden("60"), 20, 80},
      {"tension_300_kPa_within_1_ms", sudden("300"), 40, 95, true, true},
      {"tension_in_one_segment", {alone}, 0, 30, true},
      {"left_bundle_branch_block", {delayed}, 20, 75, true, true},
      {"rate_30", {"time.heart_rate_bpm=30"}, 35, 75},
      {"rate_120",
       {"time.heart_rate_bpm=120", "activation.onset_ms=50", "contraction.activation_duration_ms=220"},
       10,
       75},
      {"rate_220",
       {"time.heart_rate_bpm=220", "activation.onset_ms=20", "contraction.activation_duration_ms=120",
        "time.max_beats=3"},
       0,
       75,
       false,
       true},
      {"valves_1e-6",
       {"circulation.mitral_resistance_mmHg_s_per_mL=1e-6",
        "circulation.aortic_valve_resistance_mmHg_s_per_mL=1e-6",
        "circulation.characteristic_resistance_mmHg_s_per_mL=0"},
       35,
       75,
       true,
       true},
      {"valves_1e-4",
       {"circulation.mitral_resistance_mmHg_s_per_mL=1e-4",
        "circulation.aortic_valve_resistance_mmHg_s_per_mL=1e-4",
        "circulation.characteristic_resistance_mmHg_s_per_mL=0"},
       35,
       75},
      {"valves_1",
       {"circulation.mitral_resistance_mmHg_s_per_mL=1",
        "circulation.aortic_valve_resistance_mmHg_s_per_mL=1"}},
      {"valves_100",
       {"circulation.mitral_resistance_mmHg_s_per_mL=100",
        "circulation.aortic_valve_resistance_mmHg_s_per_mL=100"},
       0,
       10},
      {"compliance_1e-6", {"circulation.compliance_mL_per_mmHg=1e-6"}, 5, 75, false, true},
      {"compliance_1e-2", {"circulation.compliance_mL_per_mmHg=1e-2"}, 5, 75},
      {"compliance_1e4", {"circulation.compliance_mL_per_mmHg=1e4"}, 35, 75},
      {"aortic_stenosis", {"circulation.aortic_valve_resistance_mmHg_s_per_mL=0.5"}, 10, 60},
      {"aortic_regurgitation", {"circulation.aortic_leak_resistance_mmHg_s_per_mL=0.3"}, 35, 80, true},
  };
  return list;
}

}  // namespace

void extreme_beats(ExtremeChecks& checks) {
  for (const BeatVariant& variant : variants()) {
    if (checks.quick() && !variant.quick) continue;
    const auto check = [&](const ExtremeOutcome& outcome) {
      checks.expect(
          outcome, "ef_percent", "%", outcome.ef_percent(),
          {(variant.low + variant.high) / 2, variant.low, variant.high, "what such a heart can eject"});
      checks.expect(outcome, "min_det_F", "1", outcome.path.min_det_F, {1, 0.05, 1, "the wall stays a wall"});
    };
    check(checks.run("beats/" + variant.name, checks.wall(), kExtremeBeat, variant.settings));
    if (variant.full_order && !checks.quick())
      check(checks.run("beats/" + variant.name, checks.coarse_wall(), kExtremeBeat,
                       full_order(variant.settings)));
  }
}

}  // namespace cardiac
