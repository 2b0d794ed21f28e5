#include "cardiac/run/energy_balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include <cardiac/tissue/active_stress.hpp>

#include "polyaffine/system/block_body.hpp"
#include "support/contracting_heart.hpp"
#include "support/heart_run.hpp"

namespace cardiac {
namespace {

using polyaffine::Vec3;
using polyaffine::Vector;

// A bar of 2 × 1 × 1 mm that stretches by λ(t) along its fibres x, its sides held: a neo-Hookean solid with
// viscosity and mass, at its end a spring, a dashpot and the pressure p(t) of a cavity V = V₀ + 2 (λ − 1).
// The tension is the one that the motion needs,
//   2 (τ λ + P + P_v) + 2 k u + 2 η u̇ + ρ 2³/3 λ̈ = 2 p,  u = 2 (λ − 1).
struct Bar {
  static constexpr double kPeriod = 400, kDepth = 0.1, kLength = 2;
  static constexpr double kLambda = 20, kMu = 10, kViscosity = 300, kSpring = 3, kDashpot = 500;
  static constexpr double kDensity = 1e5;  // so heavy that the motion holds energy

  static double omega() { return 2 * polyaffine::kPi / kPeriod; }
  static double stretch(double t) { return 1 - kDepth / 2 * (1 - std::cos(omega() * t)); }
  static double rate(double t) { return -kDepth / 2 * omega() * std::sin(omega() * t); }
  static double acceleration(double t) { return -kDepth / 2 * omega() * omega() * std::cos(omega() * t); }
  static double pressure(double t) { return 2 + std::sin(omega() * t); }
  static double tension(double t) {
    const double l = stretch(t), u = kLength * (l - 1);
    const double passive = kMu * (l - 1 / l) + kLambda * std::log(l) / l + kViscosity * l * l * rate(t);
    return (pressure(t) - kSpring * u - kDashpot * kLength * rate(t) -
            kDensity * kLength * kLength / 3 * acceleration(t) - passive) /
           l;
  }

  polyaffine::testing::BlockBody body;
  Ventricle ventricle;

  Bar() {
    polyaffine::FieldTable table = polyaffine::deformation_table(body.basis, body.basis.wall_points(1));
    const int points = table.num_points();
    const FibreAxes axes = polyaffine::Mat3(polyaffine::Mat3::Identity()).reshaped().replicate(1, points);
    ventricle.wall = std::make_shared<polyaffine::FieldEnergy>(
        std::move(table),
        polyaffine::testing::BlockBody::Laws{
            std::make_shared<polyaffine::NeoHookean>(polyaffine::Lame{kLambda, kMu}),
            std::make_shared<ActiveStress>(axes), std::make_shared<polyaffine::KelvinVoigt>(kViscosity)});
    ventricle.supports = {body.support({kSpring, kDashpot, body.end_normals()})};
    ventricle.states.push_back([this](polyaffine::StateLayout& layout, const scene::Time&) {
      return std::make_shared<polyaffine::Inertia>(
          polyaffine::displacement_table(body.basis, body.basis.wall_points(2)), kDensity, 1e-3, layout);
    });
    std::vector<double> times, tensions;
    for (int i = 0; i <= 4 * kPeriod; ++i) {
      times.push_back(0.25 * i);
      tensions.push_back(tension(times.back()));
    }
    ventricle.contraction = std::make_shared<ContractionField>(
        ContractionField{TensionCurve(GivenCurve::through(times, tensions, kPeriod)),
                         Vector::Zero(points),
                         Vector::Ones(points),
                         {}});
  }

  HeartState state(double t) const {
    Vector c = Vector::Zero(ventricle.num_coefficients());
    for (int p = 0; p < body.mesh.num_points(); ++p) c[3 * p] = (stretch(t) - 1) * body.mesh.points()(0, p);
    return {t, c, Vector::Constant(1, 10 + kLength * (stretch(t) - 1)), Vector::Constant(1, pressure(t))};
  }

  EnergyBalance balance(int steps, double lasts) const {
    HeartPath path;
    for (int n = 0; n <= steps; ++n) path.steps.push_back(state(lasts * n / steps));
    return energy_balance(ventricle, {}, path).value();
  }
};

constexpr double kLasts = 270;  // no whole period, of which trapezoids are exact

// Midpoints of 20 000 intervals, to 1e-8.
double integral(const std::function<double(double)>& f) {
  constexpr int kIntervals = 20000;
  double sum = 0;
  for (int i = 0; i < kIntervals; ++i) sum += f(kLasts * (i + 0.5) / kIntervals);
  return sum * kLasts / kIntervals;
}

// Each number against its formula, in µJ; steps of 0.27 ms leave 1.2e-5 of the kinetic energy.
TEST(EnergyBalance, OfABarHasTheTermsOfTheHandCalculation) {
  const Bar bar;
  const EnergyBalance e = bar.balance(1000, kLasts);
  const double l = Bar::stretch(kLasts), u = 2 * (l - 1), log = std::log(l);
  const auto near = [](double mJ, double microjoule) {
    EXPECT_NEAR(1000 * mJ, microjoule, 2.5e-5 * std::abs(microjoule));
    EXPECT_GT(std::abs(microjoule), 0.01);
  };
  near(e.active_mJ, -2 * integral([](double t) { return Bar::tension(t) * Bar::stretch(t) * Bar::rate(t); }));
  near(e.cavities_mJ, -2 * integral([](double t) { return Bar::pressure(t) * Bar::rate(t); }));
  near(e.elastic_mJ, 2 * (Bar::kMu / 2 * (l * l - 1) - Bar::kMu * log + Bar::kLambda / 2 * log * log));
  near(e.supports_mJ, Bar::kSpring / 2 * u * u);
  near(e.kinetic_mJ, 0.5 * Bar::kDensity * 8 / 3 * std::pow(Bar::rate(kLasts), 2));
  near(e.viscosity_mJ,
       2 * Bar::kViscosity * integral([](double t) { return std::pow(Bar::stretch(t) * Bar::rate(t), 2); }));
  near(e.dashpots_mJ, Bar::kDashpot * integral([](double t) { return std::pow(2 * Bar::rate(t), 2); }));
  EXPECT_LT(e.percent(), 1e-3);
}

// Half the step, a quarter of the residual.
TEST(EnergyBalance, ClosesWithTheSquareOfTheStep) {
  const Bar bar;
  const double coarse = bar.balance(25, kLasts).percent(), fine = bar.balance(50, kLasts).percent();
  EXPECT_NEAR(coarse / fine, 4, 0.4);
  EXPECT_LT(coarse, 1);
}

TEST(EnergyBalance, TellsWhenAnEffectIsMissing) {
  Bar bar;
  const EnergyBalance whole = bar.balance(200, kLasts);
  bar.ventricle.supports.clear();
  const EnergyBalance without = bar.balance(200, kLasts);
  EXPECT_LT(whole.percent(), 0.1);
  EXPECT_NEAR(without.residual(), whole.supports_mJ + whole.dashpots_mJ, 1e-3 * std::abs(whole.active_mJ));
  EXPECT_GT(without.percent(), 5);
}

TEST(EnergyBalance, IsNoneWithoutContractionOrSteps) {
  Bar bar;
  HeartPath path;
  EXPECT_FALSE(energy_balance(bar.ventricle, {}, path));
  path.steps = {bar.state(0), bar.state(1), bar.state(2)};
  EXPECT_TRUE(energy_balance(bar.ventricle, {}, path));
  bar.ventricle.contraction = nullptr;
  EXPECT_FALSE(energy_balance(bar.ventricle, {}, path));
}

// Shipped beats: 0.025 % of healthy_lv, less of the others.
TEST(EnergyBalance, OfShippedBeatsCloses) {
  for (const char* name : {"healthy_lv", "infarct_lv"}) {
    const EnergyBalance& e = testing::shipped_run(name).result.energy.value();
    EXPECT_LT(e.percent(), 0.05) << name;
    EXPECT_GT(e.active_mJ, 200) << name;
    EXPECT_GT(e.viscosity_mJ, 0.02 * e.active_mJ) << name;
  }
}

// On the dense output of the integrator the stroke work is another sum.
TEST(EnergyBalance, WorkOnTheBloodIsTheStrokeWork) {
  const BeatResult& r = testing::shipped_run("healthy_lv").result;
  const double stroke_mJ = r.ventricles[0].haemodynamics.value().stroke_work_mJ;
  EXPECT_NEAR(r.energy.value().cavities_mJ, stroke_mJ, 0.004 * stroke_mJ);
}

// A coarse beat.
Scene beating() {
  Scene out = testing::contracting_heart();
  out.circulation.emplace();
  out.time.max_beats = 1;
  return out;
}

EnergyBalance energy_of(const Scene& scene) {
  const Outcome outcome = simulate(scene);
  EXPECT_TRUE(outcome.result.completed) << outcome.result.stop_reason;
  return outcome.result.energy.value();
}

// With all that stores and loses: 0.02 % reduced, 0.15 % in linear elements.
TEST(EnergyBalance, ClosesWithSpringsDashpotsAndMass) {
  Scene scene = beating();
  scene.tissue.density_mg_per_mm3 = 1.06;
  scene.boundary.base = scene::Base::elastic;
  scene.boundary.epicardial_stiffness_kPa_per_mm = 0.1;
  scene.boundary.epicardial_damping_kPa_ms_per_mm = 5;
  const EnergyBalance reduced = energy_of(scene);
  EXPECT_LT(reduced.percent(), 0.05);
  EXPECT_GT(reduced.dashpots_mJ, 1);
  EXPECT_GT(reduced.active_mJ, 500);
  scene.reduction.method = scene::Method::fem;
  scene.reduction.element_order = 1;
  EXPECT_LT(energy_of(scene).percent(), 0.3);
}

// 0.025 % with the tolerances of the protocol, 0.0023 % with closer ones.
TEST(EnergyBalance, ClosesBetterWhereTimeIsIntegratedMoreClosely) {
  const testing::HeartRun close(testing::shipped_protocol(
      "healthy_lv", {"time.relative_tolerance=1e-5", "time.absolute_tolerance_mm=1e-4"}));
  const double shipped = testing::shipped_run("healthy_lv").result.energy.value().percent();
  EXPECT_LT(close.result.energy.value().percent(), shipped / 5);
}

// Pressures that are told a tenth too high do a tenth more of work.
TEST(EnergyBalance, ThatDoesNotCloseIsWarnedOf) {
  const testing::HeartRun& run = testing::shipped_run("healthy_lv");
  const auto warnings = [&](const HeartPath& path) {
    const BeatResult r =
        describe_path(run.ventricle, segment_nodes(*run.ventricle.anatomy, run.protocol), run.protocol, path);
    return std::ranges::count_if(r.warnings, [](const std::string& text) {
      return text.find("does not balance") != std::string::npos;
    });
  };
  EXPECT_EQ(warnings(run.path), 0);
  HeartPath wrong = run.path;
  for (HeartState& step : wrong.steps) step.pressures_kPa *= 1.1;
  EXPECT_EQ(warnings(wrong), 1);
}

}  // namespace
}  // namespace cardiac
