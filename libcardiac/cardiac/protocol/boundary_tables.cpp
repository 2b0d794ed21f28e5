#include <cardiac/protocol/conditions.hpp>
#include <cardiac/protocol/key_binding.hpp>

namespace cardiac::protocol {
namespace {

// Nothing that is not asked for.
const char* const kNothing = "convention: nothing that is not asked for";

Condition weights_differ() {
  return {"another epicardial_base_weight than epicardial_apex_weight", [](const Protocol& p, std::size_t) {
            return p.boundary.epicardial_base_weight != p.boundary.epicardial_apex_weight;
          }};
}

// What holds an elastic base.
void add_base(TableBuilder<Boundary>& table) {
  const auto elastic = [](KeyFacts facts) {
    facts.range = {0, 1e6};
    facts.used_with = "base";
    facts.used_values = {"elastic"};
    return facts;
  };
  const std::string source = "Aróstica 2025, left ventricle: ";
  table
      .key("base", &Boundary::base,
           {.meaning =
                "clamped: the base does not move, its slope is free; elastic: springs and dashpots per "
                "reference area hold it; sliding: it does not move along its mean normal and is free "
                "across it (the ring of the left cavity as a whole neither moves nor turns in its plane). "
                "A base that moves closes the cavity by cones from its rims to the moving centre of the "
                "mitral (tricuspid) rim, which bears the pressure on them",
            .source = "Land 2015: clamped"})
      .key("base_normal_stiffness_kPa_per_mm", &Boundary::base_normal_stiffness_kPa_per_mm,
           elastic({.unit = "kPa/mm",
                    .meaning = "springs of the base along its own reference normals, per reference area",
                    .source = source + "0.1"}))
      .key("base_normal_damping_kPa_ms_per_mm", &Boundary::base_normal_damping_kPa_ms_per_mm,
           elastic({.unit = "kPa·ms/mm",
                    .meaning = "dashpots of the base along its own reference normals, per reference area",
                    .source = source + "5",
                    .also = {contracts()}}))
      .key("base_inplane_stiffness_kPa_per_mm", &Boundary::base_inplane_stiffness_kPa_per_mm,
           elastic({.unit = "kPa/mm",
                    .meaning = "springs of the base across its normals, per reference area",
                    .source = source + "0.1"}))
      .key("base_inplane_damping_kPa_ms_per_mm", &Boundary::base_inplane_damping_kPa_ms_per_mm,
           elastic({.unit = "kPa·ms/mm",
                    .meaning = "dashpots of the base across its normals, per reference area",
                    .source = source + "5",
                    .also = {contracts()}}));
}

void add_epicardium(TableBuilder<Boundary>& table) {
  table
      .key("epicardial_stiffness_kPa_per_mm", &Boundary::epicardial_stiffness_kPa_per_mm,
           {.unit = "kPa/mm",
            .range = {0, 1e6},
            .meaning = "springs of the pericardium per reference area; 0: none",
            .source = kNothing})
      .key("epicardial_damping_kPa_ms_per_mm", &Boundary::epicardial_damping_kPa_ms_per_mm,
           {.unit = "kPa·ms/mm",
            .range = {0, 1e6},
            .meaning = "dashpots of the pericardium per reference area; 0: none",
            .source = std::string(kNothing) + "; Pfaller 2019: 0.005",
            .also = {contracts()}})
      .key("epicardial_directions", &Boundary::epicardial_directions,
           {.meaning = "normal: springs and dashpots act along the reference normal, so that the heart may "
                       "slide and turn; all: in all directions",
            .source = "Pfaller 2019: normal",
            .also = {held()}});
}

void add_weights(TableBuilder<Boundary>& table) {
  const std::string even = "convention: the same everywhere";
  table
      .key("epicardial_apex_weight", &Boundary::epicardial_apex_weight,
           {.range = {0, 1e3},
            .meaning =
                "factor on the springs and dashpots of the pericardium at the apex of the cavity and below; "
                "towards the base it goes over to epicardial_base_weight",
            .source = even,
            .also = {held()}})
      .key("epicardial_base_weight", &Boundary::epicardial_base_weight,
           {.range = {0, 1e3},
            .meaning = "the same at the base: 1 and 0 hold the apex alone",
            .source = even,
            .also = {held()}})
      .key("epicardial_weight_law", &Boundary::epicardial_weight_law,
           {.meaning =
                "how the factor depends on the height h along the long axis, 0 at the apex of the cavity and "
                "1 at the base: linear: w = w_apex + (w_base − w_apex) h; smooth: with 3 h² − 2 h³ for h",
            .source = "convention: the simplest",
            .also = {held(), weights_differ()}})
      .key("epicardial_weight_array", &Boundary::epicardial_weight_array,
           {.meaning =
                "array of the mesh file with one number ≥ 0 a point: a further factor on the springs and "
                "dashpots of the pericardium, which act on the epicardium of both ventricles and not on the "
                "septal side of the right endocardium",
            .absent = "the factor is 1",
            .also = {held()}});
}

}  // namespace

Table boundary_table() {
  TableBuilder table("boundary", "How the ventricle is held.", &Protocol::boundary);
  add_base(table);
  add_epicardium(table);
  add_weights(table);
  return table.build();
}

}  // namespace cardiac::protocol
