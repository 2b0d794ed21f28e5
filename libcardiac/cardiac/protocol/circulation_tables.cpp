#include <cardiac/core/units.hpp>
#include <cardiac/protocol/conditions.hpp>
#include <cardiac/protocol/key_binding.hpp>

// What the cavities empty into and fill from.
namespace cardiac::protocol {
namespace {

// Values that together give the beat of a healthy heart.
const char* const kHealthy = "chosen with the others for the normal values of a healthy beat";

// What the closed loop of two ventricles has beside the left ventricle's.
void add_right_circulation(TableBuilder<std::optional<Circulation>>& table) {
  const std::string unit = "mmHg·s/mL";
  const auto of_two = [](KeyFacts facts) {
    facts.used_with = "anatomy.scheme";
    facts.used_values = {"aha29"};
    return facts;
  };
  table
      .key("right_filling_pressure_mmHg", &Circulation::right_filling_pressure_kPa,
           of_two({.unit = "mmHg",
                   .range = {0, 100},
                   .meaning =
                       "pressure before the tricuspid valve (right atrium) when the first beat begins; with "
                       "two ventricles filling_pressure_mmHg too is only the first value of that before the "
                       "mitral valve",
                   .source = "normal right atrial pressure, 2 to 6 mmHg"}),
           {kPa_per_mmHg})
      .key("tricuspid_resistance_mmHg_s_per_mL", &Circulation::tricuspid_resistance_kPa_ms_per_mm3,
           of_two({.unit = unit,
                   .range = above_zero(100),
                   .meaning = "resistance of the open tricuspid valve",
                   .source = "of the order of Regazzoni 2022: 0.0075"}),
           {resistance_per_mmHg_s_per_mL})
      .key("pulmonary_valve_resistance_mmHg_s_per_mL",
           &Circulation::pulmonary_valve_resistance_kPa_ms_per_mm3,
           of_two({.unit = unit,
                   .range = above_zero(100),
                   .meaning = "resistance of the open pulmonary valve",
                   .source = "Regazzoni 2022: 0.0075"}),
           {resistance_per_mmHg_s_per_mL})
      .key("pulmonary_characteristic_resistance_mmHg_s_per_mL",
           &Circulation::pulmonary_characteristic_resistance_kPa_ms_per_mm3,
           of_two({.unit = unit,
                   .range = {0, 100},
                   .meaning = "resistance between the pulmonary valve and the compliance",
                   .source = kHealthy}),
           {resistance_per_mmHg_s_per_mL})
      .key("pulmonary_peripheral_resistance_mmHg_s_per_mL",
           &Circulation::pulmonary_peripheral_resistance_kPa_ms_per_mm3,
           of_two({.unit = unit,
                   .range = above_zero(1000),
                   .meaning = "resistance of the lungs, from the compliance to the pulmonary veins",
                   .source = "Regazzoni 2022: 0.046 + 0.0015"}),
           {resistance_per_mmHg_s_per_mL})
      .key("pulmonary_compliance_mL_per_mmHg", &Circulation::pulmonary_compliance_mm3_per_kPa,
           of_two({.unit = "mL/mmHg",
                   .range = above_zero(200),
                   .meaning = "compliance of the pulmonary arteries",
                   .source = std::string(kHealthy) + "; Regazzoni 2022: 20"}),
           {compliance_per_mL_per_mmHg})
      .key("pulmonary_venous_compliance_mL_per_mmHg", &Circulation::pulmonary_venous_compliance_mm3_per_kPa,
           of_two({.unit = "mL/mmHg",
                   .range = above_zero(500),
                   .meaning = "compliance of the pulmonary veins and the left atrium",
                   .source = "Regazzoni 2022: 16"}),
           {compliance_per_mL_per_mmHg})
      .key("systemic_venous_compliance_mL_per_mmHg", &Circulation::systemic_venous_compliance_mm3_per_kPa,
           of_two({.unit = "mL/mmHg",
                   .range = above_zero(500),
                   .meaning = "compliance of the systemic veins and the right atrium",
                   .source = std::string(kHealthy) + "; Regazzoni 2022: 11.4"}),
           {compliance_per_mL_per_mmHg})
      .key("initial_pulmonary_pressure_mmHg", &Circulation::initial_pulmonary_pressure_kPa,
           of_two({.unit = "mmHg",
                   .range = {0, 300},
                   .meaning = "pressure of the pulmonary compliance when the first beat begins",
                   .source = "near the limit cycle of the default heart; counts to the volume of the blood"}),
           {kPa_per_mmHg});
}

// What a sick valve has: a leak backwards, and a loss that grows with the square of the flow.
void add_valves(TableBuilder<std::optional<Circulation>>& table) {
  struct Row {
    std::string valve;
    std::optional<double> Circulation::*leak;
    double Circulation::*stenosis;
    bool of_two;
  };
  const std::vector<Row> rows{{"mitral", &Circulation::mitral_leak_resistance_kPa_ms_per_mm3,
                               &Circulation::mitral_stenosis_kPa_ms2_per_mm6, false},
                              {"aortic", nullptr, &Circulation::aortic_stenosis_kPa_ms2_per_mm6, false},
                              {"tricuspid", &Circulation::tricuspid_leak_resistance_kPa_ms_per_mm3,
                               &Circulation::tricuspid_stenosis_kPa_ms2_per_mm6, true},
                              {"pulmonary", &Circulation::pulmonary_leak_resistance_kPa_ms_per_mm3,
                               &Circulation::pulmonary_stenosis_kPa_ms2_per_mm6, true}};
  for (const Row& row : rows) {
    const auto of_two = [&](KeyFacts facts) {
      if (!row.of_two) return facts;
      facts.used_with = "anatomy.scheme";
      facts.used_values = {"aha29"};
      return facts;
    };
    if (row.leak != nullptr)
      table.key(row.valve + "_leak_resistance_mmHg_s_per_mL", row.leak,
                of_two({.unit = "mmHg·s/mL",
                        .range = above_zero(1000),
                        .meaning = "resistance of the closed " + row.valve +
                                   " valve to backward flow (regurgitation)",
                        .absent = "the valve is tight"}),
                {resistance_per_mmHg_s_per_mL});
    table.key(row.valve + "_stenosis_mmHg_s2_per_mL2", row.stenosis,
              of_two({.unit = "mmHg·s²/mL²",
                      .range = {0, 10},
                      .meaning = "loss B of the open " + row.valve +
                                 " valve, Δp = R q + B q²; a narrow orifice of A cm² has B = 0.0004/A² "
                                 "(simplified Bernoulli, 4 v²)",
                      .source = "convention: a healthy valve; Hatle 1980: 4 v²"}),
              {stenosis_per_mmHg_s2_per_mL2});
  }
}

// Which circulation, where it is not made of windkessels.
void add_loop(TableBuilder<std::optional<Circulation>>& table) {
  table
      .key("loop", &Circulation::loop,
           {.meaning = "windkessel: the values of this table; closed_2022: atria, arteries and veins of the "
                       "healthy closed loop of Regazzoni 2022, its times stretched to the beat (with one "
                       "ventricle also its right one); network: the compartments and elements of "
                       "[[circulation.compartment]] and [[circulation.element]]; svzerod: those of "
                       "svzerod_file",
            .source = "convention: the simplest"})
      .key("svzerod_file", &Circulation::svzerod_file,
           {.meaning = "model of svZeroDSolver (.json): vessels, junctions, boundary conditions, "
                       "valves, chambers, closed-loop heart",
            .absent = "needed by the loop svzerod",
            .used_with = "loop",
            .used_values = {"svzerod"},
            .path = true})
      .key("svzerod_units", &Circulation::svzerod_units,
           {.meaning = "units of svzerod_file: mmHg, mL and s; dyn/cm², cm³ and s; Pa, m³ and s",
            .absent = "needed by the loop svzerod: files do not tell",
            .used_with = "loop",
            .used_values = {"svzerod"}})
      .key("lv_chamber", &Circulation::lv_chamber,
           {.meaning = "chamber of svzerod_file that the left ventricle of the mesh stands for",
            .absent = "the one called LV, left_ventricle or the closed-loop heart's",
            .used_with = "loop",
            .used_values = {"svzerod"}})
      .key("rv_chamber", &Circulation::rv_chamber,
           {.meaning = "chamber of svzerod_file that the right ventricle of the mesh stands for",
            .absent = "the one called RV, right_ventricle or the closed-loop heart's",
            .used_with = "loop",
            .used_values = {"svzerod"},
            .also = {two_ventricles()}});
}

Table circulation_table() {
  const std::string unit = "mmHg·s/mL";
  const std::string source = "three-element windkessel, Westerhof 1969";
  TableBuilder table("circulation",
                     "Valves, arteries and veins around the cavities: windkessels, or a network.",
                     &Protocol::circulation);
  table
      .key("filling_pressure_mmHg", &Circulation::filling_pressure_kPa,
           {.unit = "mmHg",
            .range = {0, 100},
            .meaning = "pressure before the mitral valve (atrium)",
            .source = "normal left atrial and end-diastolic pressure, 4 to 12 mmHg"},
           {kPa_per_mmHg})
      .key("mitral_resistance_mmHg_s_per_mL", &Circulation::mitral_resistance_kPa_ms_per_mm3,
           {.unit = unit,
            .range = above_zero(100),
            .meaning = "resistance of the open mitral valve",
            .source = "of the order of Regazzoni 2022: 0.0075"},
           {resistance_per_mmHg_s_per_mL})
      .key("aortic_valve_resistance_mmHg_s_per_mL", &Circulation::aortic_valve_resistance_kPa_ms_per_mm3,
           {.unit = unit,
            .range = above_zero(100),
            .meaning = "resistance of the open aortic valve",
            .source = "Regazzoni 2022: 0.0075"},
           {resistance_per_mmHg_s_per_mL})
      .key("aortic_leak_resistance_mmHg_s_per_mL", &Circulation::aortic_leak_resistance_kPa_ms_per_mm3,
           {.unit = unit,
            .range = above_zero(1000),
            .meaning = "resistance of the closed aortic valve to backward flow (regurgitation)",
            .absent = "the valve is tight"},
           {resistance_per_mmHg_s_per_mL})
      .key("characteristic_resistance_mmHg_s_per_mL", &Circulation::characteristic_resistance_kPa_ms_per_mm3,
           {.unit = unit,
            .range = {0, 100},
            .meaning = "resistance between the aortic valve and the compliance (proximal aorta)",
            .source = source},
           {resistance_per_mmHg_s_per_mL})
      .key("peripheral_resistance_mmHg_s_per_mL", &Circulation::peripheral_resistance_kPa_ms_per_mm3,
           {.unit = unit,
            .range = above_zero(1000),
            .meaning = "resistance of the small vessels, from the compliance to the veins",
            .source = source},
           {resistance_per_mmHg_s_per_mL})
      .key("compliance_mL_per_mmHg", &Circulation::compliance_mm3_per_kPa,
           {.unit = "mL/mmHg",
            .range = above_zero(1e4),
            .meaning = "compliance of the arteries",
            .source = "Regazzoni 2022: 1.372"},
           {compliance_per_mL_per_mmHg})
      .key("venous_pressure_mmHg", &Circulation::venous_pressure_kPa,
           {.unit = "mmHg",
            .range = {0, 100},
            .meaning = "pressure behind the small vessels",
            .source = "normal central venous pressure, 2 to 8 mmHg",
            .used_with = "anatomy.scheme",
            .used_values = {"aha17"}},
           {kPa_per_mmHg})
      .key("initial_aortic_pressure_mmHg", &Circulation::initial_aortic_pressure_kPa,
           {.unit = "mmHg",
            .range = {0, 300},
            .meaning = "pressure of the compliance when the first beat begins",
            .source =
                "near the limit cycle of the default heart; with two ventricles it counts to the volume of "
                "the blood, with one the limit cycle does not depend on it"},
           {kPa_per_mmHg});
  add_right_circulation(table);
  add_valves(table);
  table.all(windkessels());
  add_loop(table);
  return table.build();
}

}  // namespace

std::vector<Table> circulation_tables() {
  return {circulation_table()};
}

}  // namespace cardiac::protocol
