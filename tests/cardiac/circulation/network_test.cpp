#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cardiac/circulation/network_circulation.hpp>
#include <cardiac/core/units.hpp>
#include <cmath>
#include <polyaffine/solve/ode.hpp>
#include <random>
#include <stdexcept>

namespace cardiac {
namespace {

using polyaffine::Matrix;
using polyaffine::Vector;
using testing::HasSubstr;

constexpr double kR = resistance_per_mmHg_s_per_mL, kC = compliance_per_mL_per_mmHg;

Windkessel arteries() {
  return {.proximal_resistance_kPa_ms_per_mm3 = 0.04 * kR,
          .peripheral_resistance_kPa_ms_per_mm3 = kR,
          .compliance_mm3_per_kPa = 1.3 * kC,
          .reference_pressure_kPa = 0.6};
}

Valve sick_valve(double resistance, double leak) {
  return {.resistance_kPa_ms_per_mm3 = resistance * kR,
          .leak_kPa_ms_per_mm3 = leak * kR,
          .stenosis_kPa_ms2_per_mm6 = 1e-4 * stenosis_per_mmHg_s2_per_mL2};
}

TwoSidedLoop two_sided() {
  TwoSidedLoop loop;
  loop.left = {sick_valve(0.01, 2), {.resistance_kPa_ms_per_mm3 = 0.007 * kR}, arteries(), 16 * kC};
  loop.right = {{.resistance_kPa_ms_per_mm3 = 0.01 * kR}, sick_valve(0.007, 1), arteries(), 12 * kC};
  return loop;
}

// Largest difference of two tables in parts of the largest entry.
double difference(const Matrix& a, const Matrix& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

void expect_same(const CirculationModel& network, const CirculationModel& loop, const Vector& z,
                 const Vector& p) {
  const auto found = network.rates(0, z, p), expected = loop.rates(0, z, p);
  EXPECT_GT(expected.values.cwiseAbs().maxCoeff(), 0);
  EXPECT_LT(difference(found.values, expected.values), 1e-13);
  EXPECT_LT(difference(found.by_states, expected.by_states), 1e-13);
  EXPECT_LT(difference(found.by_pressures, expected.by_pressures), 1e-13);
  for (int k = 0; k < loop.num_cavities(); ++k) {
    const auto a = network.side(k, 0, z, p), b = loop.side(k, 0, z, p);
    EXPECT_NEAR(a.artery_kPa, b.artery_kPa, 1e-12);
    EXPECT_NEAR(a.before_kPa, b.before_kPa, 1e-12);
    EXPECT_NEAR(a.outflow_mm3_per_ms, b.outflow_mm3_per_ms, 1e-9);
    EXPECT_NEAR(a.inflow_mm3_per_ms, b.inflow_mm3_per_ms, 1e-9);
    EXPECT_NEAR(a.run_off_mm3_per_ms, b.run_off_mm3_per_ms, 1e-9);
  }
}

TEST(Network, HoldsTheLoopOfALeftHeart) {
  LeftHeartLoop loop;
  loop.filling_pressure_kPa = 1.2;
  loop.mitral = sick_valve(0.01, 3);
  loop.aortic = sick_valve(0.007, 0.8);
  loop.arteries = arteries();
  const NetworkCirculation network(network_of(loop, 10), 800);
  const LeftHeartCirculation same(loop);
  for (const double p : {0.3, 1.3, 9.9, 10.4, 16.0})
    expect_same(network, same, Vector{{120000, 10}}, Vector{{p}});
  EXPECT_FALSE(network.is_closed());
  EXPECT_EQ(network.initial_states(), Vector{{10}});
  EXPECT_EQ(network.filling_pressures(), Vector{{1.2}});
  EXPECT_DOUBLE_EQ(network.slowest_ms(), same.slowest_ms());
}

TEST(Network, HoldsTheLoopOfTwoSides) {
  const Vector vessels{{11, 2, 1.4, 0.7}}, filling{{1.4, 0.7}};
  const NetworkCirculation network(network_of(two_sided(), vessels, filling), 800);
  const TwoSidedCirculation same(two_sided());
  Vector z(6);
  z << 120000, 130000, vessels;
  for (const double p : {0.5, 1.5, 12.0}) expect_same(network, same, z, Vector{{p, p / 5 + 0.4}});
  EXPECT_TRUE(network.is_closed());
  EXPECT_EQ(network.compliances(), same.compliances());
  EXPECT_EQ(network.initial_states(), vessels);
}

TEST(Network, TellsTheSameColumnsAsItsLoop) {
  LeftHeartLoop loop;
  loop.filling_pressure_kPa = 1.2;
  loop.mitral = sick_valve(0.01, 3);
  loop.aortic = sick_valve(0.007, 0.8);
  loop.arteries = arteries();
  const NetworkCirculation network(network_of(loop, 10), 800);
  const Vector z{{120000, 10}}, p{{14}};
  const auto told = network.readings(0, z, p);
  for (const auto& expected : LeftHeartCirculation(loop).readings(0, z, p)) {
    const auto found = std::ranges::find_if(told, [&](const auto& reading) {
      return reading.name == expected.name && reading.quantity == expected.quantity;
    });
    ASSERT_NE(found, told.end()) << expected.name;
    EXPECT_NEAR(found->value, expected.value, 1e-9 * (1 + std::abs(expected.value))) << expected.name;
  }
}

// The closed loop of Regazzoni et al. 2022 as a network of four chambers.
TEST(Network, HoldsThePublishedClosedLoop) {
  const ClosedLoop loop = healthy_closed_loop();
  const ClosedLoopState start = healthy_closed_loop_state();
  const NetworkCirculation network(network_of(loop, start, false, false), 1);
  ASSERT_EQ(network.num_cavities(), 0);
  ASSERT_EQ(network.num_states(), closed_loop_size);
  EXPECT_TRUE(network.is_closed());
  const Vector none(0);
  // Its order: pressures, volumes, flows.
  const auto ordered = [](const ClosedLoopState& y) {
    Vector out(closed_loop_size);
    out << y.segment<4>(pressure_systemic_arteries), y.segment<4>(volume_la),
        y.segment<4>(flow_systemic_arteries);
    return out;
  };
  EXPECT_LT((network.initial_states() - ordered(start)).norm(), 1e-9);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> factor(0.7, 1.3);
  for (int i = 0; i < 20; ++i) {
    const double t = 40.0 * i;
    const ClosedLoopState y = start.unaryExpr([&](double value) { return value * factor(random); });
    const ClosedLoopState rates =
        closed_loop_rates(loop, t, y, chamber_pressure(loop, loop.lv, t, y[volume_lv]),
                          chamber_pressure(loop, loop.rv, t, y[volume_rv]));
    EXPECT_LT(difference(network.rates(t, ordered(y), none).values, ordered(rates)), 1e-12) << t;
  }

  const auto rate = [&](double t, const Vector& y, Vector& dy) { dy = network.rates(t, y, none).values; };
  const auto solution =
      polyaffine::solve_ode(rate, 0, network.initial_states(), Vector::LinSpaced(801, 9 * 800.0, 10 * 800.0),
                            {.relative_tolerance = 1e-8, .absolute_tolerance = 1e-7, .max_step = 5});
  ASSERT_TRUE(solution.finished()) << solution.message;
  const Vector end = solution.states.col(800);
  for (int i = 0; i < closed_loop_size; ++i)
    EXPECT_NEAR(end[i] / network.initial_states()[i], 1, 1e-3) << i;  // as published
  constexpr int kLeftVentricle = 5;
  const Vector volume = solution.states.row(kLeftVentricle).transpose() / mm3_per_mL;
  double peak = 0;
  for (int i = 0; i <= 800; ++i)
    for (const auto& reading : network.readings(7200 + i, solution.states.col(i), none))
      if (reading.name == "left_ventricle" && reading.quantity == CirculationModel::Quantity::pressure)
        peak = std::max(peak, reading.value / kPa_per_mmHg);
  EXPECT_NEAR(volume.minCoeff(), 66.96, 0.005);  // half a unit of the last published digit
  EXPECT_NEAR(volume.maxCoeff(), 136.74, 0.005);
  EXPECT_NEAR(peak, 119.68, 0.005);
  EXPECT_NEAR(1 - volume.minCoeff() / volume.maxCoeff(), 0.510, 0.0005);
}

Compartment compartment(const std::string& name, CompartmentType type, double value = 0) {
  Compartment out;
  out.name = name;
  out.type = type;
  (type == CompartmentType::vessel ? out.compliance_mm3_per_kPa : out.pressure_kPa) = value;
  return out;
}

Element element(const std::string& name, const std::string& from, const std::string& to, double R) {
  Element out;
  out.name = name;
  out.from = from;
  out.to = to;
  out.valve.resistance_kPa_ms_per_mm3 = R;
  return out;
}

// A ventricle, an atrium, junctions, an inertance, a pump, a narrow vessel and an inertial valve.
CirculationNetwork everything() {
  CirculationNetwork out;
  out.compartments = {compartment("veins", CompartmentType::vessel, 9000),
                      compartment("atrium", CompartmentType::chamber),
                      compartment("lv", CompartmentType::ventricle, 1),
                      compartment("root", CompartmentType::junction),
                      compartment("arch", CompartmentType::junction),
                      compartment("aorta", CompartmentType::vessel, 8000)};
  Chamber& atrium = out.compartments[1].chamber;
  atrium.elastance = {1e-5, 2e-5, 100, 120, 150, 4000};
  out.compartments[1].initial_volume_mm3 = 50000;
  out.elements = {element("return", "veins", "atrium", 0.003), element("mitral", "atrium", "lv", 0.002),
                  element("aortic", "lv", "root", 0.002),      element("narrow", "root", "arch", 0.004),
                  element("pump", "lv", "arch", 0.02),         element("wide", "arch", "aorta", 0.001),
                  element("body", "aorta", "veins", 0.13)};
  out.elements[0].inertance_kPa_ms2_per_mm3 = 0.05;
  out.elements[1].type = ElementType::valve;
  out.elements[1].valve.leak_kPa_ms_per_mm3 = 100;
  out.elements[1].inertance_kPa_ms2_per_mm3 = 0.03;
  out.elements[2].type = ElementType::valve;
  out.elements[3].valve.stenosis_kPa_ms2_per_mm6 = 2e-5;
  out.elements[4].type = ElementType::pump;
  out.elements[4].head_kPa = 6;
  return out;
}

TEST(Network, DerivativesAreThoseOfTheRates) {
  const NetworkCirculation network(everything(), 800);
  ASSERT_EQ(network.num_states(), 6);  // of the cavity, two vessels, the atrium, two flows
  const Vector z{{120000, 1.5, 10, 60000, 200, 80}};
  for (const double pressure : {1.0, 9.0, 14.0}) {
    const Vector p{{pressure}};
    const auto at = network.rates(180, z, p);
    for (int i = 0; i < 6; ++i) {
      const double h = 1e-5 * (i == 1 || i == 2 ? 1 : 100);
      Vector up = z, down = z;
      up[i] += h;
      down[i] -= h;
      const Vector by = (network.rates(180, up, p).values - network.rates(180, down, p).values) / (2 * h);
      EXPECT_LT((by - at.by_states.col(i)).norm(), 1e-5 * (1e-6 + at.by_states.col(i).norm())) << i;
      EXPECT_EQ(by.norm() > 0, i != 0) << i;  // the volume of the cavity plays no part
    }
    const double h = 1e-6;
    const Vector by = (network.rates(180, z, Vector{{pressure + h}}).values -
                       network.rates(180, z, Vector{{pressure - h}}).values) /
                      (2 * h);
    EXPECT_LT((by - at.by_pressures.col(0)).norm(), 1e-5 * at.by_pressures.col(0).norm());
    EXPECT_GT(by.norm(), 1e-3);
  }
}

TEST(Network, KeepsItsBlood) {
  const NetworkCirculation network(everything(), 800);
  const Vector z{{120000, 1.5, 10, 60000, 200, 80}};
  const Vector rates = network.rates(180, z, Vector{{14}}).values;
  EXPECT_GT(rates.cwiseAbs().maxCoeff(), 1);
  EXPECT_NEAR(rates[0] + rates[3] + network.compliances().dot(rates), 0, 1e-9);
}

TEST(Network, JunctionsLetOutWhatComesIn) {
  const NetworkCirculation network(everything(), 800);
  const Vector z{{120000, 1.5, 10, 60000, 200, 80}};
  for (const double p : {1.0, 14.0}) {
    double aortic = 0, narrow = 0, pump = 0, wide = 0, root = 0, arch = 0;
    for (const auto& r : network.readings(180, z, Vector{{p}})) {
      if (r.name == "aortic") aortic = r.value;
      if (r.name == "narrow") narrow = r.value;
      if (r.name == "pump") pump = r.value;
      if (r.name == "wide") wide = r.value;
      if (r.name == "root") root = r.value;
      if (r.name == "arch") arch = r.value;
    }
    EXPECT_NEAR(aortic, narrow, 1e-9 * std::abs(pump));
    EXPECT_NEAR(narrow + pump, wide, 1e-9 * std::abs(pump));
    EXPECT_NEAR((0.004 + 2e-5 * std::abs(narrow)) * narrow, root - arch, 1e-9);
    EXPECT_NEAR(0.02 * pump, p + 6 - arch, 1e-9);
    EXPECT_NEAR(0.001 * wide, arch - 10, 1e-9);
  }
}

TEST(Network, TellsWhatIsWrongWithIt) {
  const auto text = [](auto change) {
    CirculationNetwork network = everything();
    change(network);
    const auto fault = fault_of(network);
    return fault ? fault->key + ": " + fault->text : "";
  };
  EXPECT_EQ(text([](CirculationNetwork&) {}), "");
  EXPECT_THAT(text([](auto& n) { n.elements[6].to = "vein"; }),
              HasSubstr("to: found \"vein\", expected the name"));
  EXPECT_THAT(text([](auto& n) { n.compartments[0].compliance_mm3_per_kPa = 0; }),
              HasSubstr("compliance_mL_per_mmHg"));
  EXPECT_THAT(text([](auto& n) { n.compartments[5].name = "the aorta"; }), HasSubstr("letters, digits"));
  EXPECT_THAT(text([](auto& n) { n.elements[1].name = "aortic"; }), HasSubstr("twice"));
  EXPECT_THAT(text([](auto& n) { n.elements[6].valve.resistance_kPa_ms_per_mm3 = 0; }),
              HasSubstr("resistance"));
  EXPECT_THAT(text([](auto& n) { n.elements[2].type = ElementType::resistance; }),
              HasSubstr("no valve from \"lv\""));
  EXPECT_THAT(text([](auto& n) { n.elements[1].valve.leak_kPa_ms_per_mm3 = INFINITY; }),
              HasSubstr("leak_resistance"));
  EXPECT_THAT(text([](auto& n) { n.elements[3].inertance_kPa_ms2_per_mm3 = 1; }),
              HasSubstr("only inertances"));
  EXPECT_THAT(text([](auto& n) {
                n.compartments.push_back(compartment("a", CompartmentType::vessel, 1));
                n.compartments.push_back(compartment("b", CompartmentType::vessel, 1));
                n.elements.push_back(element("ab", "a", "b", 1));
              }),
              HasSubstr("\"a\" is not connected with \"veins\""));
  EXPECT_THAT(text([](auto& n) { n.elements[1].between = "aorta"; }), HasSubstr("that no compartment has"));
  CirculationNetwork wrong = everything();
  wrong.elements[0].from = "nowhere";
  EXPECT_THROW(NetworkCirculation(wrong, 800), std::invalid_argument);
}

TEST(TimeSeries, IsStraightBetweenSamplesAndRepeats) {
  const TimeSeries series{{0, 10, 40}, {1, 3, 1}};
  EXPECT_DOUBLE_EQ(series.at(5), 2);
  EXPECT_DOUBLE_EQ(series.at(25), 2);
  EXPECT_DOUBLE_EQ(series.at(85), 2);
  EXPECT_DOUBLE_EQ(series.at(-15), 2);
  EXPECT_DOUBLE_EQ((TimeSeries{{0}, {7}}).at(99), 7);
}

}  // namespace
}  // namespace cardiac
