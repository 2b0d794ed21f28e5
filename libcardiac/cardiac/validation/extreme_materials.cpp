#include <algorithm>
#include <cmath>
#include <sstream>

#include <cardiac/validation/extreme_checks.hpp>

namespace cardiac {
namespace {

constexpr double kShear = 3.356;  // kPa, as kExtremePassive

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

double bulk_modulus(double poisson) {
  return 2 * kShear * (1 + poisson) / (3 * (1 - 2 * poisson));
}

// Volume that a small pressure adds, reduced and full order, as the wall becomes incompressible.
void incompressibility(ExtremeChecks& checks) {
  const std::vector<double> ratios = checks.quick()
                                         ? std::vector<double>{0.3, 0.49, 0.49999}
                                         : std::vector<double>{0.3, 0.4, 0.45, 0.49, 0.499, 0.4999, 0.49999};
  std::vector<std::pair<std::string, double>> moduli;
  for (const double nu : ratios) moduli.emplace_back("nu_" + text(nu), bulk_modulus(nu));
  moduli.emplace_back("kappa_1e5_mu", 1e5 * kShear);
  for (const char* preset : {"fast", "accurate"}) {
    double before = 0;
    for (const auto& [name, kappa] : moduli) {
      const std::vector<std::string> settings{
          "tissue.bulk_modulus_kPa=" + text(kappa),
          "reduction.local_bulk_modulus_kPa=" + text(std::min(6.0, kappa)), "cavities.pressure_mmHg=0.15",
          "time.load_steps=1"};
      const std::string scene = "materials/" + name;
      const auto fem = checks.run(scene, checks.wall(), kExtremePassive, full_order(settings));
      auto reduced_settings = settings;
      reduced_settings.push_back("reduction.preset=" + std::string(preset));
      const auto reduced = checks.run(scene, checks.wall(), kExtremePassive, reduced_settings);
      const double compliance = (reduced.cavity_ratio() - 1) / (fem.cavity_ratio() - 1);
      const std::string suffix = std::string("_") + preset;
      checks.expect(reduced, "compliance_over_full_order" + suffix, "1", compliance,
                    {1, 0.9, 1.1, "neither locking nor giving way"});
      if (before > 0)
        checks.expect(reduced, "compliance_change" + suffix, "1", compliance / before,
                      {1, 0.95, 1.05, "no locking or oscillation from one modulus to the next"});
      before = compliance;
    }
  }
}

// Segments 7 and 8 softer or stiffer than the rest, under 7.5 mmHg.
void contrast(ExtremeChecks& checks) {
  const std::string region = "region=[{segments=[7, 8], stiffness_factor=";
  for (const bool fem : {false, true}) {
    const auto run = [&](double factor) {
      const std::vector<std::string> settings{region + text(factor) + "}]"};
      return checks.run("materials/stiffness_" + text(factor), checks.wall(), kExtremePassive,
                        fem ? full_order(settings) : settings);
    };
    const auto even = run(1);
    double last = even.cavity_ratio();
    checks.expect(even, "cavity_ratio", "1", last, {1, 1.1, 3, "inflates"});
    for (const double factor :
         checks.quick() ? std::vector<double>{1e6} : std::vector<double>{10, 1e3, 1e6}) {
      const auto stiff = run(factor);
      checks.expect(stiff, "cavity_ratio", "1", stiff.cavity_ratio(),
                    {last, 1, last * (1 + 1e-6), "a stiffer part: less than before, more than none"});
      last = stiff.cavity_ratio();
    }
    if (fem && checks.quick()) continue;
    for (const double factor :
         checks.quick() ? std::vector<double>{1e-6} : std::vector<double>{0.1, 1e-3, 1e-6}) {
      const auto soft = run(factor);
      checks.expect_or_stop(soft, "cavity_ratio", "1", soft.cavity_ratio(),
                            {even.cavity_ratio(), even.cavity_ratio(), 20, "a softer part: more than even"});
    }
  }
}

}  // namespace

void extreme_materials(ExtremeChecks& checks) {
  incompressibility(checks);
  contrast(checks);
}

}  // namespace cardiac
