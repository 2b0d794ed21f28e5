#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cardiac/circulation/network_circulation.hpp>
#include <cardiac/circulation/svzerod.hpp>
#include <cardiac/circulation/windkessel.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <polyaffine/core/error.hpp>
#include <polyaffine/solve/ode.hpp>

namespace cardiac {
namespace {

using nlohmann::json;
using polyaffine::Matrix;
using polyaffine::Vector;
using testing::HasSubstr;

Matrix run(const NetworkCirculation& network, const Vector& times, double max_step = 5) {
  const auto rate = [&](double t, const Vector& y, Vector& dy) {
    dy = network.rates(t, y, Vector(0)).values;
  };
  const auto solution =
      polyaffine::solve_ode(rate, 0, network.initial_states(), times,
                            {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-9, .max_step = max_step});
  EXPECT_TRUE(solution.finished()) << solution.message;
  return solution.states;
}

double reading(const NetworkCirculation& network, const std::string& name,
               CirculationModel::Quantity quantity, double t, const Vector& z) {
  for (const auto& r : network.readings(t, z, Vector(0)))
    if (r.name == name && r.quantity == quantity) return r.value;
  ADD_FAILURE() << "nothing is called " << name;
  return 0;
}

// A pulse of flow into a vessel with an RCR behind it; mmHg, mL, s.
json rcr_file() {
  json times, flows;
  for (int i = 0; i <= 40; ++i) {
    times.push_back(0.02 * i);
    flows.push_back(i < 16 ? 400 * std::sin(polyaffine::kPi * i / 16) : 0.0);
  }
  return {{"simulation_parameters", {{"number_of_cardiac_cycles", 5}}},
          {"boundary_conditions",
           {{{"bc_name", "INFLOW"}, {"bc_type", "FLOW"}, {"bc_values", {{"Q", flows}, {"t", times}}}},
            {{"bc_name", "OUT"},
             {"bc_type", "RCR"},
             {"bc_values", {{"Rp", 0.05}, {"C", 1.3}, {"Rd", 1.1}, {"Pd", 5}}}}}},
          {"vessels",
           {{{"vessel_id", 0},
             {"vessel_name", "branch0_seg0"},
             {"boundary_conditions", {{"inlet", "INFLOW"}, {"outlet", "OUT"}}},
             {"zero_d_element_type", "BloodVessel"},
             {"zero_d_element_values", {{"R_poiseuille", 0.01}, {"C", 0}, {"L", 0}}}}}},
          {"initial_condition", {{"P_c:OUT", 80}}}};
}

TEST(SvZeroD, AnRcrGivesTheCurveOfTheWindkessel) {
  const NetworkCirculation network(read_svzerod(rcr_file().dump(), "rcr.json"), 1);
  const Windkessel w{.proximal_resistance_kPa_ms_per_mm3 = 0.06 * resistance_per_mmHg_s_per_mL,
                     .peripheral_resistance_kPa_ms_per_mm3 = 1.1 * resistance_per_mmHg_s_per_mL,
                     .compliance_mm3_per_kPa = 1.3 * compliance_per_mL_per_mmHg,
                     .reference_pressure_kPa = 5 * kPa_per_mmHg};
  // Straight between the samples of the file, every 20 ms of 800.
  const auto inflow = [](double t) {
    const double s = std::fmod(t, 800) / 20, i = std::floor(s);
    const auto sample = [](double k) { return k < 16 ? 400 * std::sin(polyaffine::kPi * k / 16) : 0.0; };
    return (sample(i) + (s - i) * (sample(i + 1) - sample(i))) * flow_per_mL_per_s;
  };
  const auto rate = [&](double t, const Vector& p, Vector& dp) {
    dp[0] = -windkessel_residual(w, p[0], 0, inflow(t)) / w.compliance_mm3_per_kPa;
  };
  const Vector times = Vector::LinSpaced(401, 0, 4000);
  const auto built_in =
      polyaffine::solve_ode(rate, 0, Vector::Constant(1, 80 * kPa_per_mmHg), times,
                            {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-9, .max_step = 5});
  const Matrix found = run(network, times);
  ASSERT_EQ(found.rows(), 1);
  EXPECT_GT(found.maxCoeff() - found.minCoeff(), 20 * kPa_per_mmHg);
  for (int i = 0; i <= 400; ++i) {
    EXPECT_NEAR(found(0, i) / built_in.states(0, i), 1, 1e-6) << times[i];
    const double before =
        reading(network, "INFLOW", CirculationModel::Quantity::pressure, times[i], found.col(i));
    EXPECT_NEAR(before / inlet_pressure(w, built_in.states(0, i), inflow(times[i])), 1, 1e-6) << times[i];
  }
}

// The closed loop of Regazzoni et al. 2022 with tanh valves, in Pa, m³ and s as svZeroDSolver's users write
// it.
json closed_loop_file() {
  constexpr double Pa = 133.322387415, m3 = 1e-6, kR = Pa / m3, kC = m3 / Pa;
  json vessels = json::array(), chambers = json::array(), valves = json::array(), start = json::object();
  const auto vessel = [&](const char* name, double R, double C, double L, double p, double q,
                          const char* before, const char* behind) {
    vessels.push_back({{"vessel_id", vessels.size()},
                       {"vessel_name", name},
                       {"zero_d_element_type", "BloodVesselCRL"},
                       {"zero_d_element_values", {{"R_poiseuille", R * kR}, {"C", C * kC}, {"L", L * kR}}}});
    start[std::string("pressure:") + before + ":" + name] = p * Pa;
    start[std::string("flow:") + name + ":" + behind] = q * m3;
  };
  vessel("AR_SYS", 0.733, 1.372, 5e-3, 87.675, 71.104, "AV", "J0");
  vessel("VEN_SYS", 0.32, 11.363, 5e-4, 35.898, 94.039, "J0", "J1");
  vessel("AR_PUL", 0.046, 20, 5e-4, 19.545, 94.084, "PV", "J2");
  vessel("VEN_PUL", 0.0015, 16, 5e-4, 15.004, 473.279, "J2", "J3");
  const auto chamber = [&](const char* name, double EA, double EB, double TC, double TR, double tC, double V0,
                           double V) {
    chambers.push_back({{"type", "LinearElastanceChamber"},
                        {"name", name},
                        {"values", {{"Emax", EA * Pa / m3}, {"Epass", EB * Pa / m3}, {"Vrest", V0 * m3}}},
                        {"activation_function",
                         {{"type", "piecewise_cosine"},
                          {"contract_start", tC},
                          {"relax_start", tC + TC},
                          {"contract_duration", TC},
                          {"relax_duration", TR}}}});
    start[std::string("Vc:") + name] = V * m3;
  };
  chamber("LA", 0.07, 0.18, 0.17, 0.17, 0.9, 4, 87.183);
  chamber("LV", 4.482, 0.17, 0.25, 0.4, 0.1, 42, 118.52);
  chamber("RA", 0.06, 0.07, 0.17, 0.17, 0.9, 4, 86.833);
  chamber("RV", 0.2, 0.029, 0.25, 0.4, 0.1, 16, 166.177);
  const auto valve = [&](const char* name, const char* from, const char* to) {
    valves.push_back({{"type", "ValveTanh"},
                      {"name", name},
                      {"params",
                       {{"Rmin", 0.0075 * kR},
                        {"Rmax", 750 * kR},
                        {"Steepness", 20 / Pa},
                        {"upstream_block", from},
                        {"downstream_block", to}}}});
  };
  valve("MV", "LA", "LV");
  valve("AV", "LV", "AR_SYS");
  valve("TV", "RA", "RV");
  valve("PV", "RV", "AR_PUL");
  const auto junction = [](const char* name, const char* from, const char* to) {
    return json{{"junction_name", name},
                {"junction_type", "NORMAL_JUNCTION"},
                {"inlet_blocks", {from}},
                {"outlet_blocks", {to}}};
  };
  return {{"simulation_parameters", {{"cardiac_period", 0.8}}},
          {"vessels", vessels},
          {"junctions",
           {junction("J0", "AR_SYS", "VEN_SYS"), junction("J1", "VEN_SYS", "RA"),
            junction("J2", "AR_PUL", "VEN_PUL"), junction("J3", "VEN_PUL", "LA")}},
          {"boundary_conditions", json::array()},
          {"chambers", chambers},
          {"valves", valves},
          {"initial_condition", start}};
}

constexpr SvZeroDFactors kSi{1e-3, 1e9, 1e3};

TEST(SvZeroD, AClosedLoopGivesTheCurveOfTheOneBuiltIn) {
  const NetworkCirculation read(read_svzerod(closed_loop_file().dump(), "loop.json", kSi), 1);
  CirculationNetwork own = network_of(healthy_closed_loop(), healthy_closed_loop_state(), false, false);
  for (Element& e : own.elements)
    if (e.type == ElementType::valve) {
      e.valve.law = ValveLaw::tanh;
      e.valve.leak_kPa_ms_per_mm3 = 750 * resistance_per_mmHg_s_per_mL;
      e.valve.sharpness_per_kPa = 20 / kPa_per_mmHg;
    }
  const NetworkCirculation built_in(own, 1);
  ASSERT_EQ(read.num_states(), closed_loop_size);
  EXPECT_TRUE(read.is_closed());
  EXPECT_DOUBLE_EQ(read.network().period_ms, 800);
  const Vector times = Vector::LinSpaced(81, 0, 1600);
  const Matrix a = run(read, times), b = run(built_in, times);
  const std::vector<std::pair<const char*, const char*>> names{{"LV", "left_ventricle"},
                                                               {"RV", "right_ventricle"},
                                                               {"LA", "left_atrium"},
                                                               {"AR_SYS", "systemic_arteries"},
                                                               {"VEN_PUL", "pulmonary_veins"}};
  for (const auto& [theirs, ours] : names)
    for (int i = 0; i <= 80; ++i) {
      const auto quantity = CirculationModel::Quantity::pressure;
      const double p = reading(built_in, ours, quantity, times[i], b.col(i));
      EXPECT_NEAR(reading(read, theirs, quantity, times[i], a.col(i)), p, 1e-6 * (1 + std::abs(p)))
          << ours << " at " << times[i];
    }
}

TEST(SvZeroD, AMeshStandsForAChamber) {
  SvZeroDHeart heart;
  heart.has_lv = true;
  const NetworkCirculation network(read_svzerod(closed_loop_file().dump(), "loop.json", kSi, heart), 1);
  ASSERT_EQ(network.num_cavities(), 1);
  EXPECT_EQ(network.names(0).inlet, "MV");
  EXPECT_EQ(network.names(0).outlet, "AV");
  EXPECT_EQ(network.names(0).artery, "AR_SYS");
  EXPECT_NEAR(network.filling_pressures()[0], 0.17 * (118.52 - 42) * kPa_per_mmHg, 1e-9);
  SvZeroDHeart other = heart;
  other.lv = "ventricle";
  EXPECT_THAT([&] { read_svzerod(closed_loop_file().dump(), "loop.json", kSi, other); },
              testing::ThrowsMessage<polyaffine::InputError>(
                  AllOf(HasSubstr("loop.json: found no chamber \"ventricle\""), HasSubstr("lv_chamber"))));
}

// The inertance of a chamber's outflow lies between it and its valve.
TEST(SvZeroD, AChamberWithInductanceReachesItsValveBeyondIt) {
  json file = closed_loop_file();
  file["chambers"][1] = {{"type", "ChamberElastanceInductor"},
                         {"name", "LV"},
                         {"values",
                          {{"Emax", 4e8},
                           {"Emin", 2e7},
                           {"Vrd", 3e-5},
                           {"Vrs", 2e-5},
                           {"t_active", 0.1},
                           {"t_twitch", 0.5},
                           {"Impedance", 3e4}}}};
  SvZeroDHeart heart;
  heart.has_lv = true;
  const NetworkCirculation coupled(read_svzerod(file.dump(), "loop.json", kSi, heart), 1);
  EXPECT_EQ(coupled.names(0).outlet, "AV");
  EXPECT_EQ(coupled.kinds().flows, 5);
  // With its own chamber: p = E(t) (V − V₀(t)), and L q̇ = p − p_junction.
  const NetworkCirculation alone(read_svzerod(file.dump(), "loop.json", kSi), 1);
  const Vector z = alone.initial_states();
  const double t = 350;  // the middle of the twitch: A = 1
  using enum CirculationModel::Quantity;
  EXPECT_NEAR(reading(alone, "LV", pressure, t, z), 4e8 * (118.52e-6 - 2e-5) * 1e-3, 1e-6);
  EXPECT_NEAR(reading(alone, "LV", pressure, 50, z), 2e7 * (118.52e-6 - 3e-5) * 1e-3, 1e-9);
  // The flow of the inertance passes the valve: Δp = R q of the open one.
  Vector flowing = z;
  int index = -1;
  for (int i = 0; i < z.size(); ++i) {
    Vector more = z;
    more[i] += 1;
    if (std::abs(reading(alone, "LV_impedance", flow, t, more) - reading(alone, "LV_impedance", flow, t, z)) >
        0.5)
      index = i;
  }
  ASSERT_GE(index, 0);
  flowing[index] = 300;
  EXPECT_NEAR(reading(alone, "AV", flow, t, flowing), 300, 1e-6);
  EXPECT_NEAR(reading(alone, "LV_out", pressure, t, flowing) - reading(alone, "AR_SYS", pressure, t, flowing),
              0.0075 * resistance_per_mmHg_s_per_mL * 300, 1e-3);
}

// R, then C, then L; behind a junction that splits.
TEST(SvZeroD, VesselsAndJunctionsObeyTheirEquations) {
  json file = rcr_file();
  file["vessels"][0]["zero_d_element_values"] = {
      {"R_poiseuille", 0.02}, {"C", 0.4}, {"L", 1e-3}, {"stenosis_coefficient", 1e-4}};
  file["vessels"][0]["boundary_conditions"].erase("outlet");
  for (const int id : {1, 2})
    file["vessels"].push_back({{"vessel_id", id},
                               {"vessel_name", "leg" + std::to_string(id)},
                               {"boundary_conditions", {{"outlet", "OUT" + std::to_string(id)}}},
                               {"zero_d_element_type", "BloodVessel"},
                               {"zero_d_element_values", {{"R_poiseuille", 0.1 * id}}}});
  file["boundary_conditions"][1]["bc_name"] = "OUT1";
  file["boundary_conditions"].push_back(
      {{"bc_name", "OUT2"}, {"bc_type", "RESISTANCE"}, {"bc_values", {{"R", 2.0}, {"Pd", 3.0}}}});
  file["junctions"] = {{{"junction_name", "J0"},
                        {"junction_type", "NORMAL_JUNCTION"},
                        {"inlet_vessels", {0}},
                        {"outlet_vessels", {1, 2}}}};
  const NetworkCirculation network(read_svzerod(file.dump(), "split.json"), 1);
  ASSERT_EQ(network.num_states(), 3);  // two capacitors and a flow
  const Vector z{{10, 9, 150}};
  const double t = 100;
  const auto quantity = [&](const char* name, CirculationModel::Quantity q) {
    return reading(network, name, q, t, z);
  };
  using enum CirculationModel::Quantity;
  const double in = quantity("INFLOW", flow), R = 0.02 * resistance_per_mmHg_s_per_mL,
               B = 1e-4 * stenosis_per_mmHg_s2_per_mL2;
  EXPECT_GT(in, 100);
  EXPECT_NEAR(quantity("INFLOW", pressure) - quantity("branch0_seg0", pressure), (R + B * in) * in, 1e-9);
  const double one = quantity("leg1", flow), two = quantity("leg2", flow), split = quantity("J0", pressure);
  EXPECT_NEAR(one + two, 150, 1e-9);
  EXPECT_NEAR(split - quantity("OUT1", pressure), (0.1 + 0.05) * resistance_per_mmHg_s_per_mL * one, 1e-9);
  EXPECT_NEAR(split - 3 * kPa_per_mmHg, 2.2 * resistance_per_mmHg_s_per_mL * two, 1e-9);
}

json closed_loop_heart_file() {
  return {{"vessels",
           {{{"vessel_id", 0},
             {"vessel_name", "aorta_segment"},
             {"boundary_conditions", {{"outlet", "BODY"}}},
             {"zero_d_element_type", "BloodVessel"},
             {"zero_d_element_values", {{"R_poiseuille", 0.02}}}}}},
          {"boundary_conditions",
           {{{"bc_name", "BODY"},
             {"bc_type", "ClosedLoopRCR"},
             {"bc_values", {{"Rp", 0.08}, {"Rd", 1.0}, {"C", 1.0}, {"closed_loop_outlet", true}}}}}},
          {"closed_loop_blocks",
           {{{"outlet_blocks", {"aorta_segment"}},
             {"closed_loop_type", "ClosedLoopHeartAndPulmonary"},
             {"cardiac_cycle_period", 0.9},
             {"parameters",
              {{"Tsa", 0.4},      {"tpwave", 9},    {"Erv_s", 1.2},    {"Elv_s", 3},     {"iml", 0.5},
               {"imr", 0.8},      {"Lra_v", 2e-4},  {"Rra_v", 0.01},   {"Lrv_a", 2e-4},  {"Rrv_a", 0.03},
               {"Lla_v", 3e-4},   {"Rla_v", 0.006}, {"Llv_a", 1e-4},   {"Rlv_ao", 0.03}, {"Vrv_u", 10},
               {"Vlv_u", 6},      {"Rpd", 0.1},     {"Cp", 1.1},       {"Cpa", 0.6},     {"Kxp_ra", 9},
               {"Kxv_ra", 0.005}, {"Kxp_la", 9},    {"Kxv_la", 0.008}, {"Emax_ra", 0.2}, {"Emax_la", 0.3},
               {"Vaso_ra", 5},    {"Vaso_la", 9}}}}}},
          {"initial_condition",
           {{"V_RA:CLH", 40},
            {"V_RV:CLH", 95},
            {"V_LA:CLH", 40},
            {"V_LV:CLH", 95},
            {"P_pul:CLH", 8},
            {"P_c:BODY", 50},
            {"pressure:CLH:J_heart_outlet", 65}}}};
}

TEST(SvZeroD, TheClosedLoopHeartPumps) {
  const NetworkCirculation network(read_svzerod(closed_loop_heart_file().dump(), "heart.json"), 1);
  EXPECT_TRUE(network.is_closed());
  const Vector times = Vector::LinSpaced(181, 9 * 900, 10 * 900);
  const Matrix z = run(network, times, 2);
  const Vector start = network.initial_states();
  const auto blood = [&](const Vector& y) {
    return network.compliances().dot(y) + y.segment(network.kinds().pressures, network.kinds().volumes).sum();
  };
  EXPECT_NEAR(blood(z.col(180)) / blood(start), 1, 1e-8);
  using enum CirculationModel::Quantity;
  double ejected = 0, back = 0, highest = 0;
  for (int i = 1; i <= 180; ++i) {
    const double q = reading(network, "aortic_valve", flow, times[i], z.col(i)) * 5;
    (q > 0 ? ejected : back) += q;
    highest = std::max(highest, reading(network, "aorta", pressure, times[i], z.col(i)));
  }
  EXPECT_GT(ejected, 30 * mm3_per_mL);
  EXPECT_LT(ejected, 110 * mm3_per_mL);
  EXPECT_LT(-back, 0.02 * ejected);  // its closed valve has 1000 mmHg·s/mL
  EXPECT_GT(highest, 80 * kPa_per_mmHg);
  EXPECT_LT(highest, 160 * kPa_per_mmHg);
}

TEST(SvZeroD, ErrorsNameFileBlockAndKey) {
  const auto message = [](const json& file) -> std::string {
    try {
      read_svzerod(file.dump(1), "model.json");
    } catch (const polyaffine::InputError& error) {
      return error.what();
    }
    return "";
  };
  json file = rcr_file();
  file["boundary_conditions"][1]["bc_values"].erase("Rd");
  EXPECT_THAT(message(file), HasSubstr("model.json: boundary_conditions[1].bc_values.Rd: missing"));
  file = rcr_file();
  file["boundary_conditions"][1]["bc_values"]["C"] = "big";
  EXPECT_THAT(message(file), HasSubstr("bc_values.C: found \"big\", expected a number"));
  file = rcr_file();
  file["boundary_conditions"][1]["bc_type"] = "CORONARY";
  EXPECT_THAT(message(file),
              AllOf(HasSubstr("boundary_conditions[1].bc_type: found \"CORONARY\""), HasSubstr("RCR")));
  file = rcr_file();
  file["vessels"][0]["boundary_conditions"]["outlet"] = "OUTT";
  EXPECT_THAT(message(file), HasSubstr("found the boundary condition \"OUTT\""));
  file = rcr_file();
  file["boundary_conditions"][1]["bc_values"]["Rd"] = -1.0;
  EXPECT_THAT(message(file), HasSubstr("bc_values.Rd: found -1.0, expected a number of at least 0"));
  file = closed_loop_file();
  file["valves"][0]["params"]["upstream_block"] = "LX";
  EXPECT_THAT(message(file), HasSubstr("valves[0].params.upstream_block: found \"LX\""));
  EXPECT_THAT([] { read_svzerod("{\n \"vessels\": [,]\n}", "model.json"); },
              testing::ThrowsMessage<polyaffine::InputError>(HasSubstr("model.json:2: ")));
}

}  // namespace
}  // namespace cardiac
