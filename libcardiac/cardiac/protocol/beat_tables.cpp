#include <cardiac/core/units.hpp>
#include <cardiac/protocol/conditions.hpp>
#include <cardiac/protocol/key_binding.hpp>

namespace cardiac::protocol {
namespace {

// Values that together give the beat of a healthy heart.
const char* const kHealthy = "chosen with the others for the normal values of a healthy beat";

// Numerics: what looser or tighter values change was measured.
const char* const kMeasured = "measured: tighter values leave the ejection fraction of a healthy beat";

Table activation_table() {
  TableBuilder table("activation", "When the muscle is excited.", &Protocol::activation);
  table
      .key("mode", &Activation::mode,
           {.meaning =
                "uniform: everywhere at onset_ms; sites: a wave from the sites, the eikonal equation in "
                "the metric of the fibres",
            .source = "convention: the simplest"})
      .key("onset_ms", &Activation::onset_ms,
           {.unit = "ms",
            .range = {0, 10000},
            .meaning = "time of the first excitation in the beat",
            .source = "convention: the end of the filling belongs to the beat"})
      .key("site_segments", &Activation::site_segments,
           {.range = {1, 29},
            .meaning = "AHA segments whose endocardial centre is a site",
            .source = "convention: no site unless it is named",
            .used_with = "mode",
            .used_values = {"sites"}})
      .key("sites_mm", &Activation::sites_mm,
           {.unit = "mm",
            .meaning = "further sites [x, y, z]; the nearest vertex of the mesh counts",
            .source = "convention: no site unless it is named",
            .used_with = "mode",
            .used_values = {"sites"}})
      .key("conduction_along_fibre_mm_per_ms", &Activation::conduction_along_fibre_mm_per_ms,
           {.unit = "mm/ms",
            .range = above_zero(10),
            .meaning = "conduction velocity along the fibre",
            .source = "Niederer 2011: 0.60–0.62",
            .used_with = "mode",
            .used_values = {"sites"}})
      .key("conduction_across_fibre_mm_per_ms", &Activation::conduction_across_fibre_mm_per_ms,
           {.unit = "mm/ms",
            .range = above_zero(10),
            .meaning = "conduction velocity across the fibre",
            .source = "Niederer 2011: 0.19–0.23",
            .used_with = "mode",
            .used_values = {"sites"}});
  table.all(contracts());
  return table.build();
}

Table contraction_table() {
  const std::string source = "Aróstica 2025";
  TableBuilder table("contraction", "Active tension along the fibre.", &Protocol::contraction);
  table
      .key("model", &Contraction::model,
           {.meaning = "simplified Bestel–Clément–Sorine: dτ/dt = −|a| τ + σ0 max(a, 0), a between "
                       "activation_rate_per_s and −relaxation_rate_per_s",
            .source = "Bestel, Clément, Sorine 2001; Aróstica 2025"})
      .key("contractility_kPa", &Contraction::contractility_kPa,
           {.unit = "kPa",
            .range = {0, 2000},
            .meaning = "asymptotic tension σ0 (see model)",
            .source = "Aróstica 2025: 150"})
      .key("activation_rate_per_s", &Contraction::activation_rate_per_ms,
           {.unit = "1/s", .range = above_zero(5000), .meaning = "rate a while active", .source = source},
           {1 / ms_per_s})
      .key("relaxation_rate_per_s", &Contraction::relaxation_rate_per_ms,
           {.unit = "1/s", .range = above_zero(1000), .meaning = "rate −a while relaxing", .source = source},
           {1 / ms_per_s})
      .key("activation_duration_ms", &Contraction::activation_duration_ms,
           {.unit = "ms",
            .range = above_zero(5000),
            .meaning = "time from excitation to the onset of relaxation; one that is given is kept at every "
                       "heart rate",
            .source = source + ": 484 − 160 ms; Bazett 1920: the square root",
            .absent = "324 ms √(beat / 800 ms), so that systole follows time.heart_rate_bpm"})
      .key("switch_width_ms", &Contraction::switch_width_ms,
           {.unit = "ms",
            .range = {0.1, 500},
            .meaning = "width w of the switches ½ (1 ± tanh(t/w)) between the two rates",
            .source = source})
      .key("cross_fibre_fraction", &Contraction::cross_fibre_fraction,
           {.range = {0, 1},
            .meaning = "tension across the fibre as a fraction of the tension along it",
            .source = "Lin & Yin 1998: 0.4 and more; 0.25 for a healthy beat: EF 58 %, with 0.4 49 %, "
                      "without it 74 %"});
  return table.build();
}

Table cavities_table() {
  TableBuilder table("cavities", "Prescribed pressure in the cavity; not together with [circulation].",
                     &Protocol::cavities);
  table
      .key("pressure_mmHg", &Cavities::pressure_kPa,
           {.unit = "mmHg",
            .range = {-100, 1000},
            .meaning = "pressure that is reached from zero, in time.load_steps steps; negative: suction",
            .required = true},
           {kPa_per_mmHg})
      .key("right_pressure_mmHg", &Cavities::right_pressure_kPa,
           {.unit = "mmHg",
            .range = {0, 1000},
            .meaning = "the same in the right ventricle, on a mesh that has one",
            .source = "convention: no load unless it is named",
            .used_with = "anatomy.scheme",
            .used_values = {"aha29"}},
           {kPa_per_mmHg});
  return table.build();
}

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

Table circulation_table() {
  const std::string unit = "mmHg·s/mL";
  const std::string source = "three-element windkessel, Westerhof 1969";
  TableBuilder table("circulation",
                     "Valves, arteries and veins around the cavity: a three-element windkessel.",
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
  return table.build();
}

Table boundary_table() {
  TableBuilder table("boundary", "How the ventricle is held.", &Protocol::boundary);
  table
      .key("base", &Boundary::base,
           {.meaning = "clamped: the base does not move, its slope is free", .source = "Land 2015"})
      .key("epicardial_stiffness_kPa_per_mm", &Boundary::epicardial_stiffness_kPa_per_mm,
           {.unit = "kPa/mm",
            .range = {0, 1e6},
            .meaning = "springs of the pericardium per reference area; 0: none",
            .source = "convention: nothing that is not asked for"})
      .key("epicardial_damping_kPa_ms_per_mm", &Boundary::epicardial_damping_kPa_ms_per_mm,
           {.unit = "kPa·ms/mm",
            .range = {0, 1e6},
            .meaning = "dashpots of the pericardium per reference area; 0: none",
            .source = "convention: nothing that is not asked for; Pfaller 2019: 0.005",
            .also = {contracts()}})
      .key("epicardial_directions", &Boundary::epicardial_directions,
           {.meaning = "normal: springs and dashpots act along the reference normal, so that the heart may "
                       "slide and turn; all: in all directions",
            .source = "Pfaller 2019: normal",
            .also = {held()}});
  return table.build();
}

Table time_table() {
  TableBuilder table("time", "Beats, steps and tolerances.", &Protocol::time);
  table
      .key("heart_rate_bpm", &Time::beat_ms,
           {.unit = "1/min",
            .range = {20, 300},
            .meaning = "heart rate; a beat lasts 60000/heart_rate_bpm ms, with a circulation and without",
            .source = "Regazzoni 2022: 75",
            .also = {contracts()}},
           {ms_per_min, true})
      .key("max_beats", &Time::max_beats,
           {.range = {1, 200},
            .meaning = "beats after which the run ends even if the loop has not closed",
            .source = "three times what a healthy heart takes",
            .also = {beats()}})
      .key("limit_cycle_tolerance_percent", &Time::limit_cycle_tolerance_percent,
           {.unit = "%",
            .range = above_zero(100),
            .meaning =
                "the beats end when the last is nearer than this to the one that would repeat itself: "
                "pressures of the vessels in parts of themselves, volumes of the stroke volume; what is "
                "left is estimated from how the beats differ, not the difference of two of them",
            .source = "convention: finer than the scatter of a heart from beat to beat",
            .also = {beats()}})
      .key("relative_tolerance", &Time::relative_tolerance,
           {.range = {1e-10, 0.1},
            .meaning = "relative tolerance of the time integration",
            .source = kMeasured,
            .also = {contracts()}})
      .key("absolute_tolerance_mm", &Time::absolute_tolerance_mm,
           {.unit = "mm",
            .range = {1e-10, 10},
            .meaning = "absolute tolerance of the displacement in the time integration",
            .source = kMeasured,
            .also = {contracts()}})
      .key("absolute_tolerance_mmHg", &Time::absolute_tolerance_kPa,
           {.unit = "mmHg",
            .range = {1e-10, 10},
            .meaning = "absolute tolerance of pressures in the time integration",
            .source = kMeasured,
            .also = {beats()}},
           {kPa_per_mmHg})
      .key("max_step_ms", &Time::max_step_ms,
           {.unit = "ms",
            .range = {0.01, 1000},
            .meaning = "longest time step",
            .source = kMeasured,
            .also = {contracts()}})
      .key("load_steps", &Time::load_steps,
           {.range = {1, 1000},
            .meaning = "steps in which a static load is raised; cut further where needed",
            .source = "convention: as many rows of a static loading; the end does not depend on it",
            .also = {prescribed()}})
      .key("duration_ms", &Time::duration_ms,
           {.unit = "ms",
            .range = above_zero(1e6),
            .meaning = "simulated time without circulation, in which the muscle contracts at heart_rate_bpm "
                       "(with a circulation: by beats)",
            .source = "one beat at the default heart rate",
            .also = {prescribed()}});
  return table.build();
}

Table output_table() {
  const std::string all = "convention: everything unless left out";
  TableBuilder table("output", "What is written, and how often.", &Protocol::output);
  table
      .key("interval_ms", &Output::interval_ms,
           {.unit = "ms",
            .range = {0.1, 1e5},
            .meaning = "time between two rows or meshes",
            .source = "convention: finer than the frames of cine MRI, 20 to 50 ms",
            .also = {contracts()}})
      .key("tables", &Output::tables,
           {.meaning = "strain, affine, global strain, cavity and circulation tables (.csv)", .source = all})
      .key("figures", &Output::figures,
           {.meaning = "bull's-eyes, strain curves, pressure–volume loop, report", .source = all})
      .key("mesh_series", &Output::mesh_series, {.meaning = "deformed meshes (.vtu, .pvd)", .source = all})
      .key("frames", &Output::frames,
           {.meaning = "unknowns of the control frames with the functions they belong to (frames.csv)",
            .source = "convention: of use only to who wants the model itself",
            .also = {reduced()}});
  return table.build();
}

Table region_table() {
  const std::string alike = "convention: like the rest";
  TableBuilder table("region", "Segments that differ from the rest: scar, ischaemia, late activation.",
                     &Protocol::regions);
  table
      .key("name", &RegionOverride::name,
           {.meaning = "what the region is called in reports",
            .source = "convention: without a name its segments stand for it"})
      .key("segments", &RegionOverride::segments,
           {.range = {1, 29},
            .meaning = "AHA segments of the region; each belongs to one region at most",
            .required = true})
      .key("tension_factor", &RegionOverride::tension_factor,
           {.range = {0, 10},
            .meaning = "factor on contraction.contractility_kPa; 0: does not contract",
            .source = alike,
            .also = {contracts()}})
      .key("stiffness_factor", &RegionOverride::stiffness_factor,
           {.range = above_zero(1e6), .meaning = "factor on the moduli of the passive law", .source = alike})
      .key("activation_delay_ms", &RegionOverride::activation_delay_ms,
           {.unit = "ms",
            .range = {0, 2000},
            .meaning = "added to the time of excitation",
            .source = alike,
            .also = {contracts()}})
      .key("border_width_percent", &RegionOverride::border_width_percent,
           {.unit = "%",
            .range = {0, 100},
            .meaning = "width of the border, in parts of the segment's size, over which the factors blend",
            .source = "chosen: a border zone of some millimetres",
            .also = {differs()}});
  return table.build();
}

}  // namespace

std::vector<Table> beat_tables() {
  return {activation_table(), contraction_table(), cavities_table(), circulation_table(),
          boundary_table(),   time_table(),        output_table(),   region_table()};
}

}  // namespace cardiac::protocol
