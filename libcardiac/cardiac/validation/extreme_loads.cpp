#include <cardiac/validation/extreme_checks.hpp>

namespace cardiac {
namespace {

// The passive cavity under pressure and suction.
void pressures(ExtremeChecks& checks) {
  for (const bool fem : {false, true}) {
    const auto run = [&](const std::string& scene, const std::vector<std::string>& settings) {
      return checks.run("loads/" + scene, checks.wall(), kExtremePassive,
                        fem ? full_order(settings) : settings);
    };
    const std::vector<std::string> stiffening{"tissue.law=mooney_rivlin", "tissue.c1_kPa=0.5",
                                              "tissue.c2_kPa=2"};
    auto settings = stiffening;
    settings.push_back("cavities.pressure_mmHg=28");
    const auto fivefold = run("fivefold", settings);
    checks.expect(fivefold, "cavity_ratio", "1", fivefold.cavity_ratio(), {5, 5, 40, "at least fivefold"});
    const auto beyond = run("beyond_the_limit_load", {"cavities.pressure_mmHg=200"});
    checks.expect_or_stop(beyond, "cavity_ratio", "1", beyond.cavity_ratio(),
                          {5, 5, 1e3, "neo-Hookean cavities have a limit load"}, kNoEquilibrium);
    const auto suction = run("suction_2_kPa", {"cavities.pressure_mmHg=-15.0012"});
    checks.expect_or_stop(suction, "cavity_ratio", "1", suction.cavity_ratio(), {0.5, 0.05, 0.7, "sucked in"},
                          kNoEquilibrium);
    const auto half = run("suction_1_kPa", {"cavities.pressure_mmHg=-7.5006"});
    checks.expect(half, "cavity_ratio", "1", half.cavity_ratio(), {0.7, 0.6, 0.8, "sucked in"});
    const auto collapse = run("suction_13_kPa", {"cavities.pressure_mmHg=-100"});
    checks.expect_or_stop(collapse, "cavity_ratio", "1", collapse.cavity_ratio(),
                          {0, -1, 0.5, "a wall that buckles, or stops"}, kNoEquilibrium);
    const auto steps = run("in_ten_steps", {"time.load_steps=10"});
    const auto one = run("in_one_step", {"time.load_steps=1"});
    checks.expect(one, "cavity_ratio", "1", one.cavity_ratio(),
                  {steps.cavity_ratio(), steps.cavity_ratio() - 1e-6, steps.cavity_ratio() + 1e-6,
                   "the same equilibrium as in ten steps"});
  }
}

// Tension at a constant pressure, without a circulation.
void tensions(ExtremeChecks& checks) {
  const std::string held =
      std::string(kExtremeBeat).substr(0, std::string(kExtremeBeat).find("[circulation]")) +
      "[cavities]\npressure_mmHg = 10\n[time]\nduration_ms = 300\nload_steps = 30\n";
  for (const bool fem : {false, true})
    for (const char* tension : {"60", "300"}) {
      std::vector<std::string> settings{
          std::string("contraction.contractility_kPa=") + tension, "contraction.activation_rate_per_s=5000",
          "contraction.switch_width_ms=0.2", "contraction.activation_duration_ms=100"};
      if (fem) settings = full_order(settings);
      const auto outcome = checks.run("loads/held_" + std::string(tension) + "_kPa_within_1_ms",
                                      checks.coarse_wall(), held, settings);
      checks.expect_or_stop(outcome, "smallest_cavity_ratio", "1", outcome.smallest_ratio(),
                            {0.5, 0.1, 0.9, "contracted against the pressure of filling"}, kNoEquilibrium);
    }
}

}  // namespace

void extreme_loads(ExtremeChecks& checks) {
  pressures(checks);
  tensions(checks);
}

}  // namespace cardiac
