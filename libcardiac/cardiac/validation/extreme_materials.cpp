#include <algorithm>
#include <cmath>
#include <utility>

#include <cardiac/validation/extreme_checks.hpp>

namespace cardiac {
namespace {

constexpr double kShear = 3.356;  // kPa, as kExtremePassive

double bulk_modulus(double poisson) {
  return 2 * kShear * (1 + poisson) / (3 * (1 - 2 * poisson));
}

// Volume that a small pressure adds, reduced and full order, as the wall becomes incompressible.
void incompressibility(ExtremeChecks& checks) {
  const std::vector<double> ratios = checks.quick()
                                         ? std::vector<double>{0.3, 0.49, 0.49999}
                                         : std::vector<double>{0.3, 0.4, 0.45, 0.49, 0.499, 0.4999, 0.49999};
  std::vector<std::pair<std::string, double>> moduli;
  moduli.reserve(ratios.size() + 1);
  for (const double nu : ratios) moduli.emplace_back("nu_" + as_text(nu), bulk_modulus(nu));
  moduli.emplace_back("kappa_1e5_mu", 1e5 * kShear);
  for (const char* preset : {"fast", "accurate"}) {
    double before = 0;
    for (const auto& [name, kappa] : moduli) {
      const std::vector<std::string> settings{
          "tissue.bulk_modulus_kPa=" + as_text(kappa),
          "reduction.local_bulk_modulus_kPa=" + as_text(std::min(6.0, kappa)), "cavities.pressure_mmHg=0.15",
          "time.load_steps=1"};
      const std::string scene = "materials/" + name;
      const auto fem = checks.run(scene, checks.wall(), kExtremePassive, full_order(settings));
      auto reduced_settings = settings;
      reduced_settings.push_back("reduction.preset=" + std::string(preset));
      const auto reduced = checks.run(scene, checks.wall(), kExtremePassive, reduced_settings);
      const double compliance = (reduced.cavity_ratio() - 1) / (fem.cavity_ratio() - 1);
      const std::string suffix = std::string("_") + preset;
      checks.expect(reduced, "compliance_over_full_order" + suffix, "1", compliance,
                    {1, 0.95, 1.05, "neither locking nor giving way"});
      if (before > 0)
        checks.expect(reduced, "compliance_change" + suffix, "1", compliance / before,
                      {1, 0.98, 1.02, "no locking or oscillation from one modulus to the next"});
      before = compliance;
    }
  }
}

// Segments 7 and 8 stiffer or softer than the rest. The functions of the reduced model reach over the borders
// of segments, so that from a contrast of some hundred on it is stiffer than full order.
void contrast(ExtremeChecks& checks) {
  const double pressure = 7.5;
  const auto run = [&](double factor, bool fem, double pressure_mmHg) {
    const std::vector<std::string> settings{
        "reduction.preset=accurate", "cavities.pressure_mmHg=" + as_text(pressure_mmHg),
        "region=[{segments=[7, 8], stiffness_factor=" + as_text(factor) + "}]"};
    return checks.run("materials/stiffness_" + as_text(factor) +
                          (pressure_mmHg == pressure ? "" : "_" + as_text(pressure_mmHg) + "_mmHg"),
                      checks.wall(), kExtremePassive, fem ? full_order(settings) : settings);
  };
  const char* const source = "full order on the same mesh";
  const auto even = run(1, false, pressure), even_full = run(1, true, pressure);
  checks.expect(even_full, "inflation", "1", even_full.inflation(), {0.8, 0.7, 0.9, "inflates"});
  checks.expect_inflation_of(even, even_full, 5, source);

  struct Step {
    double factor, percent;
    bool quick;
  };
  double last = even.inflation(), last_full = even_full.inflation();
  for (const auto& [factor, percent, quick] :
       {Step{10, 3, true}, Step{1e3, 20, false}, Step{1e6, 45, true}}) {
    if (checks.quick() && !quick) continue;
    const auto stiff = run(factor, false, pressure), stiff_full = run(factor, true, pressure);
    for (const auto& [outcome, before] : {std::pair{stiff, last}, std::pair{stiff_full, last_full}})
      checks.expect(outcome, "inflation_over_less_stiff", "1", outcome.inflation() / before,
                    {0.7, 0.4, 0.999, "a stiffer part gives less"});
    checks.expect_inflation_of(stiff, stiff_full, percent, source);
    last = stiff.inflation();
    last_full = stiff_full.inflation();
  }
  // Least share of full order's inflation: 0.96, 0.61 and 0.37 are reached.
  struct Soft {
    double factor, least;
  };
  for (const auto& [factor, least] : checks.quick()
                                         ? std::vector<Soft>{{1e-6, 0.33}}
                                         : std::vector<Soft>{{0.1, 0.92}, {1e-3, 0.55}, {1e-6, 0.33}}) {
    for (const bool fem : {false, true}) {
      if (fem && checks.quick()) continue;
      const auto soft = run(factor, fem, pressure);
      checks.expect_or_stop(
          soft, "inflation", "1", soft.inflation(),
          {1.1 * even.inflation(), 1.02 * even.inflation(), 20, "a softer part gives more, or bursts"},
          kNoEquilibrium);
    }
    // A pressure that the soft part bears.
    const auto soft = run(factor, false, factor * pressure), soft_full = run(factor, true, factor * pressure);
    const auto firm = run(1, false, factor * pressure);
    checks.expect(soft_full, "inflation_over_even", "1", soft_full.inflation() / firm.inflation(),
                  {2, 1.3, 1e5, "a softer part gives more"});
    checks.expect(soft, "inflation", "1", soft.inflation(),
                  {soft_full.inflation(),
                   std::max((factor == 0.1 ? 1.2 : 1.05) * firm.inflation(), least * soft_full.inflation()),
                   1.05 * soft_full.inflation(), "more than the even wall, no more than full order"});
  }
}

}  // namespace

void extreme_materials(ExtremeChecks& checks) {
  incompressibility(checks);
  contrast(checks);
}

}  // namespace cardiac
