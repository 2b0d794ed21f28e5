#include <cardiac/circulation/network.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/protocol/describe.hpp>
#include <cardiac/protocol/plan.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "texts.hpp"

namespace cardiac {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kHeart =
    "[mesh]\nshape = \"human_lv\"\n[fibres]\n[activation]\n[contraction]\n[circulation]\nloop = "
    "\"network\"\n";

std::string compartment(const std::string& name, const std::string& rest) {
  return "[[circulation.compartment]]\nname = \"" + name + "\"\n" + rest + "\n";
}
std::string element(const std::string& name, const std::string& from, const std::string& to,
                    const std::string& rest) {
  return "[[circulation.element]]\nname = \"" + name + "\"\nfrom = \"" + from + "\"\nto = \"" + to + "\"\n" +
         rest + "\n";
}

// The windkessel of the defaults, in one's own words.
const std::string kNetwork =
    kHeart + compartment("atrium", "type = \"pressure\"\npressure_mmHg = 10") +
    compartment("lv", "type = \"ventricle\"\npressure_mmHg = 10") +
    compartment("arteries", "compliance_mL_per_mmHg = 1.3\npressure_mmHg = 75") +
    compartment("veins", "type = \"pressure\"\npressure_mmHg = 5") +
    element("mitral", "atrium", "lv", "type = \"valve\"\nresistance_mmHg_s_per_mL = 0.01") +
    element("aortic", "lv", "arteries",
            "type = \"valve\"\nresistance_mmHg_s_per_mL = 0.007\nseries_resistance_mmHg_s_per_mL = 0.04\n"
            "between = \"aorta\"\nleak_resistance_mmHg_s_per_mL = 2") +
    element("body", "arteries", "veins", "resistance_mmHg_s_per_mL = 1\nstenosis_mmHg_s2_per_mL2 = 0.001");

TEST(NetworkTables, BecomeANetworkInTheUnitsOfAScene) {
  const Protocol protocol = parsed(kNetwork);
  ASSERT_TRUE(protocol.circulation->network);
  const CirculationNetwork& network = *protocol.circulation->network;
  ASSERT_EQ(network.compartments.size(), 4U);
  ASSERT_EQ(network.elements.size(), 3U);
  EXPECT_NEAR(network.compartments[2].compliance_mm3_per_kPa, 1300 / 0.133322387415, 1e-6);
  EXPECT_NEAR(network.compartments[1].pressure_kPa, 1.33322387415, 1e-12);
  EXPECT_EQ(network.compartments[1].type, CompartmentType::ventricle);
  EXPECT_NEAR(network.elements[2].valve.resistance_kPa_ms_per_mm3, 0.133322387415, 1e-12);
  EXPECT_NEAR(network.elements[2].valve.stenosis_kPa_ms2_per_mm6, 0.133322387415e-3, 1e-15);
  EXPECT_NEAR(network.elements[1].valve.leak_kPa_ms_per_mm3, 0.26664477483, 1e-10);
  EXPECT_EQ(network.elements[1].between, "aorta");
  EXPECT_TRUE(protocol.warnings.empty());
  EXPECT_THAT(plan(protocol, false)[7].why, HasSubstr("network of 4 compartments and 3 elements"));
}

TEST(NetworkTables, AreToldAsTheyWereGiven) {
  const auto json = resolved_json(parsed(kNetwork));
  const auto& circulation = json.at("circulation");
  EXPECT_EQ(circulation.at("loop"), "network");
  EXPECT_EQ(circulation.at("compartment").size(), 4U);
  EXPECT_EQ(circulation.at("compartment")[2].at("compliance_mL_per_mmHg"), 1.3);
  EXPECT_EQ(circulation.at("element")[1].at("from"), "lv");
  EXPECT_FALSE(circulation.contains("compliance_mL_per_mmHg"));  // of the windkessels
  const auto schema = protocol_schema();
  const auto& properties = schema.at("properties").at("circulation").at("properties");
  EXPECT_EQ(properties.at("compartment").at("type"), "array");
  EXPECT_TRUE(properties.at("element").at("items").at("properties").contains("resistance_mmHg_s_per_mL"));
  EXPECT_THAT(explain("circulation.element"), HasSubstr("[[circulation.element]]"));
  EXPECT_THAT(explain("circulation.element.stenosis_mmHg_s2_per_mL2"), HasSubstr("0.0004/A²"));
}

TEST(NetworkTables, PumpsHaveAHeadOrAFlow) {
  const std::string pump =
      kNetwork +
      element("assist", "lv", "arteries", "type = \"pump\"\nresistance_mmHg_s_per_mL = 1\nhead_mmHg = 120");
  const Element& head = parsed(pump).circulation->network->elements.at(3);
  EXPECT_EQ(head.type, ElementType::pump);
  EXPECT_NEAR(head.head_kPa, 120 * kPa_per_mmHg, 1e-12);
  EXPECT_FALSE(head.curve);
  const Protocol given = parsed(pump, {"circulation.element.4.pump_flow_mL_per_s=50"});
  EXPECT_NEAR(given.circulation->network->elements.at(3).curve->at(123), 50, 1e-12);  // mL/s are mm³/ms
  EXPECT_THAT(parsed(kNetwork, {"circulation.element.3.head_mmHg=5"}).warnings.at(0),
              HasSubstr("it goes with circulation.element.type = pump"));
}

TEST(NetworkTables, EntriesAreOverriddenByTheirNumber) {
  const Protocol protocol = parsed(kNetwork, {"circulation.compartment.3.pressure_mmHg=80"});
  EXPECT_NEAR(protocol.circulation->network->compartments[2].pressure_kPa, 80 * kPa_per_mmHg, 1e-12);
}

TEST(NetworkTables, ErrorsNameLineAndEntry) {
  EXPECT_THAT(refusal(kNetwork, {"circulation.element.3.to=vein"}),
              AllOf(HasSubstr("circulation.element.3.to: found \"vein\""),
                    HasSubstr("expected the name of a compartment: atrium, lv, arteries, veins")));
  EXPECT_THAT(refusal(kNetwork + "[[circulation.compartment]]\ncompliance_mL_per_mmHg = 1\n"),
              AllOf(HasSubstr("heart.toml:45"), HasSubstr("circulation.compartment.5.name: missing")));
  EXPECT_THAT(refusal(kHeart), HasSubstr("circulation.loop: found no compartment"));
  EXPECT_THAT(refusal(kNetwork, {"circulation.element.3.resistence_mmHg_s_per_mL=1"}),
              HasSubstr("the nearest known key is circulation.element.resistance_mmHg_s_per_mL"));
  EXPECT_THAT(refusal(kHeart + "compartment = 3\n"),
              HasSubstr("expected a table [[circulation.compartment]]"));
}

TEST(NetworkTables, PlayNoPartBesideTheWindkessels) {
  const Protocol protocol = parsed(kNetwork, {"circulation.loop=windkessel"});
  EXPECT_FALSE(protocol.circulation->network);
  ASSERT_FALSE(protocol.warnings.empty());
  EXPECT_THAT(protocol.warnings.front(), HasSubstr("plays no part: it goes with circulation.loop = network"));
}

TEST(LoopSvZeroD, WantsAFileItsUnitsAndThePeriodOfTheHeart) {
  const std::string text = kHeart.substr(0, kHeart.find("loop")) + "loop = \"svzerod\"\n";
  EXPECT_THAT(refusal(text), HasSubstr("circulation.svzerod_file: missing"));
  EXPECT_THAT(refusal(text + "svzerod_file = \"a.json\"\n"),
              AllOf(HasSubstr("circulation.svzerod_units: missing"), HasSubstr("a.json")));
  EXPECT_THAT(refusal(text + "svzerod_file = \"a.json\"\nsvzerod_units = \"mmHg_mL_s\"\n"),
              HasSubstr("no such file folder/a.json"));

  const std::filesystem::path folder = ::testing::TempDir();
  nlohmann::json model = {
      {"simulation_parameters", {{"cardiac_period", 0.8}}},
      {"chambers",
       {{{"type", "ChamberElastanceInductor"},
         {"name", "LV"},
         {"values",
          {{"Emax", 2.0},
           {"Emin", 0.1},
           {"Vrd", 20},
           {"Vrs", 15},
           {"t_active", 0.1},
           {"t_twitch", 0.4},
           {"Impedance", 0}}}}}},
      {"boundary_conditions",
       {{{"bc_name", "IN"}, {"bc_type", "PRESSURE"}, {"bc_values", {{"P", 10}}}},
        {{"bc_name", "OUT"},
         {"bc_type", "RCR"},
         {"bc_values", {{"Rp", 0.04}, {"Rd", 1}, {"C", 1.3}, {"Pd", 5}}}}}},
      {"vessels",
       {{{"vessel_id", 0},
         {"vessel_name", "veins"},
         {"boundary_conditions", {{"inlet", "IN"}}},
         {"zero_d_element_type", "BloodVessel"},
         {"zero_d_element_values", {{"R_poiseuille", 0.002}}}},
        {{"vessel_id", 1},
         {"vessel_name", "aorta"},
         {"boundary_conditions", {{"outlet", "OUT"}}},
         {"zero_d_element_type", "BloodVessel"},
         {"zero_d_element_values", {{"R_poiseuille", 0.01}}}}}},
      {"valves",
       {{{"type", "ValveTanh"},
         {"name", "mitral"},
         {"params",
          {{"Rmin", 0.01},
           {"Rmax", 1000},
           {"Steepness", 10},
           {"upstream_block", "veins"},
           {"downstream_block", "LV"}}}},
        {{"type", "PiecewiseValve"},
         {"name", "aortic"},
         {"params",
          {{"Rmin", 0.01}, {"Rmax", 1000}, {"upstream_block", "LV"}, {"downstream_block", "aorta"}}}}}}};
  std::ofstream(folder / "model.json") << model.dump(1);
  const std::string whole =
      text + "svzerod_file = \"" + (folder / "model.json").string() + "\"\nsvzerod_units = \"mmHg_mL_s\"\n";
  const Protocol protocol = parsed(whole);
  ASSERT_TRUE(protocol.circulation->network);
  EXPECT_EQ(protocol.circulation->network->period_ms, 800);
  EXPECT_THAT(refusal(whole, {"time.heart_rate_bpm=60"}),
              AllOf(HasSubstr("found a cardiac period of 800 ms"), HasSubstr("heart_rate_bpm = 75")));
  EXPECT_THAT(refusal(whole, {"circulation.lv_chamber=left"}), HasSubstr("found no chamber \"left\""));
}

}  // namespace
}  // namespace cardiac
