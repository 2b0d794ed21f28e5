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
                "the metric of the fibres; array: the times of a point array of mesh.file; table: those of "
                "the points of times_file",
            .source = "convention: the simplest"})
      .key("onset_ms", &Activation::onset_ms,
           {.unit = "ms",
            .range = {0, 10000},
            .meaning = "time of the first excitation in the beat",
            .source = "convention: the end of the filling belongs to the beat",
            .used_with = "mode",
            .used_values = {"uniform", "sites"}})
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
            .used_values = {"sites"}})
      .key("array_ms", &Activation::array_ms,
           {.unit = "ms",
            .meaning =
                "name of the point array of mesh.file that holds the time of excitation in the beat, ms",
            .absent = "array_s, or one called activation_ms",
            .used_with = "mode",
            .used_values = {"array"}})
      .key("array_s", &Activation::array_s,
           {.unit = "s",
            .meaning = "the same in seconds",
            .absent = "array_ms",
            .used_with = "mode",
            .used_values = {"array"}})
      .key("times_file", &Activation::file,
           {.meaning = "table (.csv) of points and their time of excitation in the beat, x_mm, y_mm, z_mm, "
                       "activation_ms; vertices between them have the mean of the four nearest, weighted by "
                       "the inverse square of the distance (Shepard 1968)",
            .absent = "needed by the mode table",
            .used_with = "mode",
            .used_values = {"table"},
            .path = true});
  table.all(contracts());
  return table.build();
}

Table contraction_table() {
  const std::string source = "Aróstica 2025";
  const auto of = [](std::vector<std::string> models) {
    return [models = std::move(models)](KeyFacts facts) {
      facts.used_with = "model";
      facts.used_values = models;
      return facts;
    };
  };
  const std::string simplified = "bestel_clement_sorine_simplified", full = "bestel_clement_sorine",
                    land_2017 = "land_2017";
  const auto bestel = of({simplified, full}), bridges = of({full}), fibre = of({full, land_2017}),
             land = of({land_2017}), any = of({simplified, full, land_2017});
  TableBuilder table("contraction", "Active tension along the fibre.", &Protocol::contraction);
  table
      .key("model", &Contraction::model,
           {.meaning = "bestel_clement_sorine_simplified: dτ/dt = −|a| τ + σ0 max(a, 0), a between "
                       "activation_rate_per_s and −relaxation_rate_per_s, whatever the wall does; table: "
                       "the tension of tension_file; of the tension that feels the stretch of the fibre and "
                       "its rate: bestel_clement_sorine, that equation with cross-bridges that are pulled, "
                       "and land_2017, human muscle that calcium drives",
            .source = "Bestel, Clément, Sorine 2001; Aróstica 2025; Land et al. 2017"})
      .key("contractility_kPa", &Contraction::contractility_kPa,
           bestel({.unit = "kPa",
                   .range = {0, 2000},
                   .meaning = "asymptotic tension σ0 (see model)",
                   .source = "Aróstica 2025: 150"}))
      .key(
          "activation_rate_per_s", &Contraction::activation_rate_per_ms,
          bestel(
              {.unit = "1/s", .range = above_zero(5000), .meaning = "rate a while active", .source = source}),
          {1 / ms_per_s})
      .key("relaxation_rate_per_s", &Contraction::relaxation_rate_per_ms,
           bestel({.unit = "1/s",
                   .range = above_zero(1000),
                   .meaning = "rate −a while relaxing",
                   .source = source}),
           {1 / ms_per_s})
      .key("activation_duration_ms", &Contraction::activation_duration_ms,
           bestel({.unit = "ms",
                   .range = above_zero(5000),
                   .meaning = "time from excitation to the onset of relaxation; one that is given is kept at "
                              "every heart rate",
                   .source = source + ": 484 − 160 ms; Bazett 1920: the square root",
                   .absent = "324 ms √(beat / 800 ms), so that systole follows time.heart_rate_bpm; above "
                             "300 a minute in proportion to the beat"}))
      .key("switch_width_ms", &Contraction::switch_width_ms,
           bestel({.unit = "ms",
                   .range = {0.1, 500},
                   .meaning = "width w of the switches ½ (1 ± tanh(t/w)) between the two rates",
                   .source = source}))
      .key("time_factor", &Contraction::time_factor,
           any({.range = above_zero(10),
                .meaning = "factor on the times behind the rates of the contraction and the width of its "
                           "switches: rates are divided by it",
                .source = "convention: rates of a human heart are of human muscle",
                .absent = "1, above 180 beats a minute beat / 333 ms"}))
      .key("tension_file", &Contraction::tension_file,
           {.meaning = "table (.csv) of the active tension along the fibre over the time since a point is "
                       "excited, time_ms, tension_kPa; one beat long it repeats, longer it is the whole of "
                       "time.duration_ms",
            .absent = "needed by the model table",
            .used_with = "model",
            .used_values = {"table"},
            .path = true})
      .key("cross_fibre_fraction", &Contraction::cross_fibre_fraction,
           {.range = {0, 1},
            .meaning = "tension across the fibre as a fraction of the tension along it",
            .source = "Lin & Yin 1998: 0.4 and more; 0.25 for a healthy beat: EF 58 %, with 0.4 49 %, "
                      "without it 74 %"})
      .key("overlap_slope", &Contraction::overlap_slope,
           fibre({.range = {0, 10},
                  .meaning = "slope β0 of the overlap of filaments over the stretch, 1 at the stretch 1; 0: "
                             "tension does not feel the length",
                  .source = "Land et al. 2017"}))
      .key("bridge_stiffness_kPa", &Contraction::bridge_stiffness_kPa,
           bridges({.unit = "kPa",
                    .range = above_zero(1e5),
                    .meaning = "stiffness k0 of the cross-bridges of a lasting contraction",
                    .source = "Genet et al. 2023: 260 beside a contractility of 65",
                    .absent = "4 contractility_kPa"}))
      .key("series_stiffness_kPa", &Contraction::series_stiffness_kPa,
           bridges({.unit = "kPa",
                    .range = {10, 1e7},
                    .meaning = "stiffness ks in series with the cross-bridges",
                    .source = "Genet et al. 2023: 1e8 Pa"}))
      .key("bridge_viscosity_kPa_ms", &Contraction::bridge_viscosity_kPa_ms,
           bridges({.unit = "kPa·ms",
                    .range = above_zero(1e5),
                    .meaning = "viscosity µ beside the cross-bridges",
                    .source = "Genet et al. 2023: 70 Pa s"}))
      .key("rate_destruction", &Contraction::rate_destruction,
           bridges({.range = {0, 1000},
                    .meaning = "cross-bridges α that a strain breaks, whatever its sign",
                    .source = "Genet et al. 2023"}))
      .key("reference_tension_kPa", &Contraction::reference_tension_kPa,
           land({.unit = "kPa",
                 .range = {0, 2000},
                 .meaning = "tension Tref at saturating calcium, stretch 1",
                 .source = "Land et al. 2017"}))
      .key("calcium_50_uM", &Contraction::calcium_50_uM,
           land({.unit = "uM",
                 .range = above_zero(100),
                 .meaning = "calcium Ca50 that half saturates troponin, stretch 1",
                 .source = "Land et al. 2017"}))
      .key("calcium_slope_uM", &Contraction::calcium_slope_uM,
           land({.unit = "uM",
                 .range = {-100, 0},
                 .meaning = "change β1 of Ca50 with the stretch",
                 .source = "Land et al. 2017"}))
      .key("diastolic_calcium_uM", &Contraction::diastolic_calcium_uM,
           land({.unit = "uM",
                 .range = {0, 10},
                 .meaning = "calcium long after excitation",
                 .source = "Regazzoni, Dedè, Quarteroni 2020",
                 .also = {calcium_formula()}}))
      .key("peak_calcium_uM", &Contraction::peak_calcium_uM,
           land({.unit = "uM",
                 .range = above_zero(100),
                 .meaning = "largest calcium of a single excitation",
                 .source = "Regazzoni, Dedè, Quarteroni 2020",
                 .also = {calcium_formula()}}))
      .key("calcium_rise_ms", &Contraction::calcium_rise_ms,
           land({.unit = "ms",
                 .range = above_zero(1000),
                 .meaning = "time constant of its rise, less than calcium_decay_ms",
                 .source = "Regazzoni, Dedè, Quarteroni 2020: 20 ms",
                 .absent = "time_factor 20 ms √(beat / 800 ms), of beats of at least 333 ms"}))
      .key("calcium_decay_ms", &Contraction::calcium_decay_ms,
           land({.unit = "ms",
                 .range = above_zero(5000),
                 .meaning = "time constant of its decay",
                 .source = "Regazzoni, Dedè, Quarteroni 2020: 50 ms",
                 .absent = "time_factor 50 ms √(beat / 800 ms), of beats of at least 333 ms"}))
      .key("calcium_file", &Contraction::calcium_file,
           land({.meaning = "table (.csv) of one beat of calcium since excitation, time_ms, calcium_uM, "
                            "instead of the formula",
                 .absent = "the formula of diastolic_calcium_uM, peak_calcium_uM and their times",
                 .path = true}));
  return table.build();
}

Table cavities_table() {
  TableBuilder table("cavities",
                     "Prescribed pressures or volumes of the cavities; not together with [circulation].",
                     &Protocol::cavities);
  table
      .key("pressure_mmHg", &Cavities::pressure_kPa,
           {.unit = "mmHg",
            .range = {-100, 1000},
            .meaning = "pressure that is reached from zero, in time.load_steps steps; negative: suction",
            .required = true,
            .instead = {"pressure_file", "volume_file"},
            .also = {one_pressure()}},
           {kPa_per_mmHg})
      .key("right_pressure_mmHg", &Cavities::right_pressure_kPa,
           {.unit = "mmHg",
            .range = {0, 1000},
            .meaning = "the same in the right ventricle, on a mesh that has one; beside a pressure_file "
                       "without rows of it too",
            .source = "convention: no load unless it is named",
            .used_with = "anatomy.scheme",
            .used_values = {"aha29"}},
           {kPa_per_mmHg})
      .key("pressure_file", &Cavities::pressure_file,
           {.meaning =
                "table (.csv) of the pressures over the time, time_ms, ventricle (lv, rv; without the "
                "column lv), pressure_mmHg, as in cavity.csv; the wall is loaded to the first one, then "
                "follows for time.duration_ms",
            .absent = "pressure_mmHg",
            .path = true})
      .key("volume_file", &Cavities::volume_file,
           {.meaning =
                "table (.csv) of the volumes over the time, time_ms, ventricle, volume_mL; the pressures "
                "that they take are found",
            .absent = "pressure_mmHg",
            .path = true})
      .key("repeats", &Cavities::repeats,
           {.meaning =
                "whether the file holds one beat, which repeats (yes), or all of time.duration_ms (no); "
                "auto: a table of at most 60000/time.heart_rate_bpm ms repeats",
            .source = "convention: by the length of the table",
            .also = {files()}});
  return table.build();
}

Table time_table() {
  TableBuilder table("time", "Beats, steps and tolerances.", &Protocol::time);
  table
      .key("heart_rate_bpm", &Time::beat_ms,
           {.unit = "1/min",
            .range = {20, 800},
            .meaning = "heart rate; a beat lasts 60000/heart_rate_bpm ms, with a circulation and without",
            .source = "Regazzoni 2022: 75",
            .also = {in_time()}},
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
            .also = {in_time()}})
      .key("absolute_tolerance_mm", &Time::absolute_tolerance_mm,
           {.unit = "mm",
            .range = {1e-10, 10},
            .meaning = "absolute tolerance of the displacement in the time integration",
            .source = kMeasured,
            .also = {in_time()}})
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
            .also = {in_time()}})
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
            .also = {in_time()}})
      .key("tables", &Output::tables,
           {.meaning = "strain, affine, global strain, cavity and circulation tables (.csv)", .source = all})
      .key("figures", &Output::figures,
           {.meaning = "bull's-eyes, strain curves, pressure–volume loop, report", .source = all})
      .key("mesh_series", &Output::mesh_series, {.meaning = "deformed meshes (.vtu, .pvd)", .source = all})
      .key("frames", &Output::frames,
           {.meaning = "unknowns of the control frames with the functions they belong to (frames.csv)",
            .source = "convention: of use only to who wants the model itself",
            .also = {reduced()}})
      .key(
          "mechanics", &Output::mechanics,
          {.meaning = "fibre strain, stresses and work of each segment (mechanics.csv)",
           .source = "convention: stress at every point and step is a sixth of the work of a run of one beat",
           .also = {
               {"output.tables = true", [](const Protocol& p, std::size_t) { return p.output.tables; }}}});
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
  std::vector<Table> out{activation_table(), contraction_table(), cavities_table()};
  for (auto* more : {&circulation_tables, &network_tables})
    for (Table& table : more()) out.push_back(std::move(table));
  for (Table& table : std::vector{boundary_table(), time_table(), output_table(), region_table()})
    out.push_back(std::move(table));
  return out;
}

}  // namespace cardiac::protocol
