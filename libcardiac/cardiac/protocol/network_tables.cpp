#include <cardiac/core/units.hpp>
#include <cardiac/protocol/conditions.hpp>
#include <cardiac/protocol/key_binding.hpp>

// The circulation's network of one's own.
namespace cardiac::protocol {
namespace {

KeyFacts of_type(std::vector<std::string> types, KeyFacts facts) {
  facts.used_with = "type";
  facts.used_values = std::move(types);
  return facts;
}

Table compartment_table() {
  TableBuilder table("circulation.compartment", "What holds blood at a pressure, of the loop network.",
                     &Protocol::compartments);
  const std::string none = "convention: none unless it is named";
  table
      .key("name", &NetworkCompartment::name,
           {.meaning =
                "name, of letters, digits and underscores; its columns in circulation.csv are NAME_mmHg "
                "and NAME_mL",
            .required = true})
      .key(
          "type", &NetworkCompartment::type,
          {.meaning = "vessel: a compliance, V = C p; chamber: an elastance, p = E(t) (V − V0); ventricle: a "
                      "cavity of the mesh; pressure: one that nothing changes; junction: holds none",
           .source = "convention: most compartments are vessels"})
      .key("cavity", &NetworkCompartment::cavity,
           of_type({"ventricle"},
                   {.meaning = "which cavity of the mesh", .source = "convention: the left one"}))
      .key("compliance_mL_per_mmHg", &NetworkCompartment::compliance_mm3_per_kPa,
           of_type(
               {"vessel"},
               {.unit = "mL/mmHg", .range = {0, 1e4}, .meaning = "compliance C of a vessel", .source = none}),
           {compliance_per_mL_per_mmHg})
      .key("pressure_mmHg", &NetworkCompartment::pressure_kPa,
           of_type({"vessel", "ventricle", "pressure"},
                   {.unit = "mmHg",
                    .range = {-100, 300},
                    .meaning = "when the first beat begins: pressure of a vessel, and what the wall of a "
                               "ventricle is filled to; of the type pressure: always",
                    .source = none}),
           {kPa_per_mmHg})
      .key("active_elastance_mmHg_per_mL", &NetworkCompartment::active_kPa_per_mm3,
           of_type({"chamber"}, {.unit = "mmHg/mL",
                                 .range = {0, 1000},
                                 .meaning = "what the elastance of a chamber rises by when it contracts",
                                 .source = none}),
           {elastance_per_mmHg_per_mL})
      .key("passive_elastance_mmHg_per_mL", &NetworkCompartment::passive_kPa_per_mm3,
           of_type({"chamber"}, {.unit = "mmHg/mL",
                                 .range = {0, 1000},
                                 .meaning = "elastance of a chamber at rest",
                                 .source = none}),
           {elastance_per_mmHg_per_mL})
      .key("unstressed_volume_mL", &NetworkCompartment::unstressed_mm3,
           of_type({"chamber"}, {.unit = "mL",
                                 .range = {-1000, 1000},
                                 .meaning = "volume V0 of a chamber without pressure",
                                 .source = none}),
           {mm3_per_mL})
      .key("volume_mL", &NetworkCompartment::volume_mm3,
           of_type({"chamber"}, {.unit = "mL",
                                 .range = {0, 2000},
                                 .meaning = "volume of a chamber when the first beat begins",
                                 .source = "of the order of an atrium"}),
           {mm3_per_mL})
      .key("onset_ms", &NetworkCompartment::onset_ms,
           of_type({"chamber"}, {.unit = "ms",
                                 .range = {0, 10000},
                                 .meaning = "when in the beat a chamber begins to contract",
                                 .source = "convention: with the beat"}))
      .key("contraction_ms", &NetworkCompartment::contraction_ms,
           of_type({"chamber"}, {.unit = "ms",
                                 .range = above_zero(5000),
                                 .meaning = "how long its elastance rises, in half a cosine",
                                 .source = "Regazzoni 2022, atria: 0.17 s"}))
      .key("relaxation_ms", &NetworkCompartment::relaxation_ms,
           of_type({"chamber"}, {.unit = "ms",
                                 .range = above_zero(5000),
                                 .meaning = "how long it falls again",
                                 .source = "Regazzoni 2022, atria: 0.17 s"}));
  table.all(networks());
  return table.build();
}

Table element_table() {
  TableBuilder table("circulation.element", "What joins two compartments, of the loop network.",
                     &Protocol::elements);
  const std::string none = "convention: none unless it is named";
  table
      .key("name", &NetworkElement::name,
           {.meaning = "name, of letters, digits and underscores; its column in circulation.csv is "
                       "NAME_mL_per_s",
            .required = true})
      .key("type", &NetworkElement::type,
           {.meaning =
                "resistance: (R + B |q|) q + L dq/dt = Δp; valve: by its law; pump: as a resistance, with "
                "a head beside Δp",
            .source = "convention: most elements are vessels"})
      .key("from", &NetworkElement::from, {.meaning = "compartment that flow comes from", .required = true})
      .key("to", &NetworkElement::to, {.meaning = "compartment that it goes to", .required = true})
      .key("resistance_mmHg_s_per_mL", &NetworkElement::resistance_kPa_ms_per_mm3,
           {.unit = "mmHg·s/mL",
            .range = {0, 1e5},
            .meaning = "resistance R; of a valve: open",
            .source = none},
           {resistance_per_mmHg_s_per_mL})
      .key("inertance_mmHg_s2_per_mL", &NetworkElement::inertance_kPa_ms2_per_mm3,
           {.unit = "mmHg·s²/mL", .range = {0, 100}, .meaning = "inertance L", .source = none},
           {inertance_per_mmHg_s2_per_mL})
      .key("stenosis_mmHg_s2_per_mL2", &NetworkElement::stenosis_kPa_ms2_per_mm6,
           {.unit = "mmHg·s²/mL²",
            .range = {0, 1000},
            .meaning = "loss B that grows with the square of the flow; an orifice of A cm² has 0.0004/A²",
            .source = none},
           {stenosis_per_mmHg_s2_per_mL2})
      .key("flow_mL_per_s", &NetworkElement::flow_mm3_per_ms,
           {.unit = "mL/s",
            .range = {-5000, 5000},
            .meaning = "flow of an inertance when the first beat begins",
            .source = "convention: at rest"},
           {flow_per_mL_per_s})
      .key("leak_resistance_mmHg_s_per_mL", &NetworkElement::leak_kPa_ms_per_mm3,
           of_type({"valve"}, {.unit = "mmHg·s/mL",
                               .range = above_zero(1e9),
                               .meaning = "resistance of the closed valve to backward flow",
                               .absent = "the valve is tight"}),
           {resistance_per_mmHg_s_per_mL})
      .key("law", &NetworkElement::law,
           of_type(
               {"valve"},
               {.meaning = "smooth: open forwards, leaking backwards, joined without a kink over "
                           "smoothing_mmHg; arctan: the logarithm of the resistance passes from leak to open "
                           "(Regazzoni 2022); tanh: the resistance does (Pfaller 2019), both as sharply as "
                           "sharpness_per_mmHg says",
                .source = "convention: that of the windkessels' valves"}))
      .key("smoothing_mmHg", &NetworkElement::smoothing_kPa,
           of_type({"valve"}, {.unit = "mmHg",
                               .range = above_zero(10),
                               .meaning = "pressure over which a valve of the law smooth opens and closes",
                               .source = "measured: smaller values leave the ejection fraction"}),
           {kPa_per_mmHg})
      .key("sharpness_per_mmHg", &NetworkElement::sharpness_per_kPa,
           of_type({"valve"},
                   {.unit = "1/mmHg",
                    .range = {0, 1e6},
                    .meaning = "k of the laws arctan, ½ + arctan(½ π k Δp)/π, and tanh, ½ (1 + tanh(k Δp))",
                    .source = "Regazzoni 2022: 200"}),
           {1 / kPa_per_mmHg})
      .key("series_resistance_mmHg_s_per_mL", &NetworkElement::series_kPa_ms_per_mm3,
           of_type({"valve"}, {.unit = "mmHg·s/mL",
                               .range = {0, 100},
                               .meaning = "resistance behind a valve of the law smooth, taken as one with it "
                                          "(proximal aorta): no junction is needed between them",
                               .source = none}),
           {resistance_per_mmHg_s_per_mL})
      .key("between", &NetworkElement::between,
           of_type({"valve"}, {.meaning = "name of the pressure between the valve and that resistance",
                               .absent = "it is not told"}))
      .key("head_mmHg", &NetworkElement::head_kPa,
           of_type({"pump"}, {.unit = "mmHg",
                              .range = {-1000, 1000},
                              .meaning = "pressure that a pump makes without flow; with flow less by its "
                                         "resistance",
                              .source = none}),
           {kPa_per_mmHg})
      .key("pump_flow_mL_per_s", &NetworkElement::pump_flow_mm3_per_ms,
           of_type({"pump"}, {.unit = "mL/s",
                              .range = {-5000, 5000},
                              .meaning = "flow that a pump gives whatever the pressures are",
                              .absent = "by its head and resistance"}),
           {flow_per_mL_per_s});
  table.all(networks());
  return table.build();
}

}  // namespace

std::vector<Table> network_tables() {
  return {compartment_table(), element_table()};
}

}  // namespace cardiac::protocol
