#include <algorithm>
#include <numeric>
#include <random>
#include <sstream>

#include <cardiac/validation/extreme_checks.hpp>

namespace cardiac {
namespace {

// Settings of a beat drawn from the ranges of README.md, "Random hearts".
std::vector<std::string> draw(unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::string> out{"time.max_beats=2"};
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  const auto set = [&](const std::string& key, double low, double high) {
    std::ostringstream text;
    text << key << '=' << uniform(low, high);
    out.push_back(text.str());
  };
  set("time.heart_rate_bpm", 40, 180);
  set("circulation.filling_pressure_mmHg", 3, 25);
  set("circulation.initial_aortic_pressure_mmHg", 40, 110);
  set("circulation.peripheral_resistance_mmHg_s_per_mL", 0.3, 3);
  set("circulation.compliance_mL_per_mmHg", 0.3, 3);
  set("contraction.contractility_kPa", 30, 250);
  set("contraction.cross_fibre_fraction", 0.1, 0.5);
  set("contraction.activation_duration_ms", 150, 300);
  set("activation.onset_ms", 20, 80);
  set("tissue.C_kPa", 0.5, 8);
  set("fibres.endo_angle_deg", 40, 80);
  set("fibres.epi_angle_deg", -80, -40);
  if (uniform(0, 1) < 0.5) {
    out.push_back("activation.mode=sites");
    out.push_back("activation.site_segments=[" + std::to_string(1 + static_cast<int>(uniform(0, 16))) + "]");
    set("activation.conduction_along_fibre_mm_per_ms", 0.4, 0.8);
    set("activation.conduction_across_fibre_mm_per_ms", 0.15, 0.4);
  }
  const int scars = static_cast<int>(uniform(0, 4));
  std::vector<int> segments(17);
  std::iota(segments.begin(), segments.end(), 1);
  std::ranges::shuffle(segments, random);
  std::ostringstream regions;
  for (int k = 0; k < scars; ++k)
    regions << (k == 0 ? "" : ", ") << "{segments=[" << segments[2 * k] << ", " << segments[2 * k + 1]
            << "], tension_factor=" << uniform(0, 1) << ", stiffness_factor=" << uniform(0.5, 20)
            << ", activation_delay_ms=" << uniform(0, 100) << "}";
  if (scars > 0) out.push_back("region=[" + regions.str() + "]");
  return out;
}

bool pumps(const ExtremeOutcome& outcome) {
  const double ef = outcome.ef_percent(), peak = outcome.peak_pressure_mmHg();
  return ef > 0 && ef < 90 && peak > 10 && peak < 350;
}

}  // namespace

void extreme_random(ExtremeChecks& checks) {
  const int count = checks.quick() ? 20 : 1000;
  std::vector<ExtremeOutcome> outcomes(count);
  side_by_side(outcomes.size(), [&](std::size_t k) {
    outcomes[k] = checks.run("random/" + std::to_string(k), checks.wall(), kExtremeBeat,
                             draw(static_cast<unsigned>(k)));
  });
  std::vector<double> times;
  int completed = 0, told = 0, pumping = 0, whole = 0;
  ExtremeOutcome all;
  all.scene = "random";
  all.method = "polyaffine, " + std::to_string(count) + " protocols";
  for (const ExtremeOutcome& one : outcomes) {
    completed += one.completed();
    told += one.completed() || (!one.reason.empty() && one.told && one.finite);
    pumping += one.completed() && pumps(one);
    whole += one.completed() && one.path.min_det_F > 0.1;
    times.push_back(one.wall_s);
    all.wall_s += one.wall_s;
    all.path.time_steps += one.path.time_steps;
    all.path.newton_iterations += one.path.newton_iterations;
    all.path.cuts += one.path.cuts +
                     static_cast<int>(one.path.cost.error_test_failures + one.path.cost.convergence_failures);
    if (!one.completed()) checks.expect_refusal(one, "");
  }
  std::ranges::sort(times);
  checks.expect(all, "completed_percent", "%", 100.0 * completed / count,
                {100, 99, 100, "hearts of these ranges"});
  checks.expect(all, "pumping_of_completed_percent", "%", 100.0 * pumping / completed,
                {100, 100, 100, "ejection fraction 0 to 90 %, peak 10 to 350 mmHg"});
  checks.expect(all, "wall_above_a_tenth_of_completed_percent", "%", 100.0 * whole / completed,
                {100, 99, 100, "no point of the wall below a tenth of its volume"});
  checks.expect(all, "completed_or_told_percent", "%", 100.0 * told / count, {100, 100, 100, "none is lost"});
  checks.expect(all, "longest_over_median_time", "1", times.back() / times[times.size() / 2],
                {1, 0, 20, "none holds up the others"});
}

}  // namespace cardiac
