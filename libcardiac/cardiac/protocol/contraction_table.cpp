#include <utility>

#include <cardiac/core/units.hpp>
#include <cardiac/protocol/conditions.hpp>
#include <cardiac/protocol/key_binding.hpp>

namespace cardiac::protocol {

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

}  // namespace cardiac::protocol
