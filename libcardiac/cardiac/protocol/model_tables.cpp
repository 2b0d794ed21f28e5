#include <cardiac/protocol/conditions.hpp>
#include <cardiac/protocol/key_binding.hpp>

namespace cardiac::protocol {
namespace {

Table reduction_table() {
  TableBuilder table("reduction", "Unknowns and integration of the mechanics.", &Protocol::reduction);
  table
      .key("method", &Reduction::method,
           {.meaning = "polyaffine: control frames, one a segment unless ring_nodes says otherwise, "
                       "enriched; fem: full-order finite elements",
            .source = "measured: cardiac bench"})
      .key(
          "preset", &Reduction::preset,
          {.meaning =
               "set of enrichment, pressure_space and border_functions: fast {tt, lt}, accurate {tt, lt, ct, "
               "ltt, ttt, ll}, both with segment_linear (with weights sigmoid: segment_depth and "
               "segment_bilinear). With Cartesian axes, in which {ct, cc, lc} complete an affine map on a "
               "curved wall, fast has these and accurate {cc, lc, ctt, llt, cct} besides. Where a [[region]] "
               "differs from the rest its bulge bends the wall along l and c and its strain jumps: {lc, cc}, "
               "with fast {ct, ll} too, and border_functions. tuned: functions, pressures and points learned "
               "once for this heart from its full-order model (minutes; kept in the cache, or in a file by "
               "cardiac reduce)",
           .source = "measured: cardiac bench",
           .also = {reduced()}})
      .key("weights", &Reduction::weights,
           {.meaning =
                "influence of a control node: tents (piecewise linear in ventricular coordinates) or sigmoid "
                "(of the signed geodesic distance to the border of the node's region)",
            .source = "sigmoid: Desrues, Delingette, Sermesant; tents: measured, cardiac bench",
            .also = {reduced(), untrained()}})
      .key("sigmoid_slope", &Reduction::sigmoid_slope,
           {.range = above_zero(20),
            .meaning = "slope a of the sigmoid 1/(1 + exp(a d)), d the normalised signed distance",
            .source = "Desrues, Delingette, Sermesant",
            .used_with = "weights",
            .used_values = {"sigmoid"},
            .also = {reduced(), untrained()}})
      .key(
          "enrichment", &Reduction::enrichment,
          {.meaning =
               "monomials beside the affine {1, l, c, t} of each frame, in the local longitudinal, "
               "circumferential and depth coordinates: words of the letters l, c, t such as tt, lt, ctt. The "
               "frame of the cap, whose axes are Cartesian, has all of degree two where there are any",
           .absent = "from preset",
           .also = {reduced(), untrained()}})
      .key(
          "border_functions", &Reduction::border_functions,
          {.meaning = "a displacement {1, t, tt} of its own for every border, and every corner, between "
                      "segments whose [[region]] factors differ; with ring_nodes [4, 6, 6] and weights tents",
           .absent = "from preset",
           .also = {reduced(), untrained(), some_differ()}})
      .key("pressure_space", &Reduction::pressure_space,
           {.meaning =
                "functions of the volumetric pressure of each control node: none (every integration point on "
                "its own), segment {1}, segment_depth {1, t}, segment_linear {1, l, c, t}, "
                "segment_bilinear {1, l, c, t, lt, ct}",
            .absent = "from preset",
            .also = {reduced(), untrained(), separate_volume()}})
      .key("local_bulk_modulus_kPa", &Reduction::local_bulk_modulus_kPa,
           {.unit = "kPa",
            .range = {0, 1e6},
            .meaning =
                "part of the bulk modulus that acts at every integration point beside the pressure "
                "space; one to two shear moduli keep local volumes in check. Not given, it is 20 with "
                "[contraction], whose tension stiffens the wall (of two ventricles with preset accurate "
                "only), and 60 where a [[region]] differs as well, a tenth of tissue.bulk_modulus_kPa at "
                "most; 60 where the wall is crushed (min_det_F)",
            .source = "measured: two shear moduli of soft muscle (tissue.mu_kPa)",
            .also = {reduced(), untrained(), separate_volume(), mixed()}})
      .key("axes", &Reduction::axes,
           {.meaning =
                "components of the unknowns along heart axes (longitudinal, "
                "circumferential, radial) or Cartesian axes; auto: with one ventricle heart axes, or "
                "Cartesian ones where those turn too fast, as in papillary muscles, with a warning; with "
                "two ventricles Cartesian axes",
            .source = "measured: of one ventricle heart axes, of two Cartesian ones are nearer to full order",
            .also = {reduced(), untrained(), tents()}})
      .key("ring_nodes", &Reduction::ring_nodes,
           {.range = {3, 60},
            .meaning =
                "control nodes of each ring from apex to base, beside the one of the cap; [4, 6, 6] with "
                "ring_angles_deg 0 are the AHA segments. Strain is told by AHA segment with any number; "
                "the affine parameters are then those that fit each segment best",
            .source = "AHA, Cerqueira 2002",
            .also = {reduced()}})
      .key(
          "ring_positions", &Reduction::ring_positions,
          {.range = {0, 1},
           .meaning = "apicobasal coordinate of each ring of control nodes, 0 apex to 1 base, rising",
           .absent = "0.2, 0.5, 0.85 for the AHA segments; with other ring_nodes k/(n + 1/2) for ring k of n",
           .also = {reduced()}})
      .key(
          "ring_angles_deg", &Reduction::ring_angles_deg,
          {.unit = "deg",
           .range = {-180, 180},
           .meaning = "angle about the long axis of the first node of each ring, 0 anterior, growing towards "
                      "the septum; the others follow at equal steps",
           .absent = "0 for every ring",
           .also = {reduced()}})
      .key(
          "integration", &Reduction::integration,
          {.meaning = "integration points: cells (Gauss points of the cells between the kinks of the weights "
                      "and the borders of segments that differ), gauss (in every tetrahedron) or trained "
                      "(about half of the cells' "
                      "points, chosen once for the heart on states of other pressures, tensions and "
                      "stiffnesses, kept in the cache)",
           .source = "measured: cardiac bench",
           .also = {reduced(), untrained()}})
      .key("element_order", &Reduction::element_order,
           {.range = {1, 2},
            .meaning = "order of the elements of the full-order model; order 1 locks near incompressibility",
            .source = "measured: cardiac validate ellipsoid and land",
            .used_with = "method",
            .used_values = {"fem"}})
      .key("accuracy_percent", &Reduction::accuracy_percent,
           {.unit = "%",
            .range = {0.05, 20},
            .meaning = "largest error of displacement against full order (relative, L2 over the wall) in the "
                       "loads that a tuned model is held against: it learns until they are met",
            .source = "choice: below what images of a heart resolve",
            .used_with = "preset",
            .used_values = {"tuned"},
            .also = {reduced()}})
      .key("budget_s", &Reduction::budget_s,
           {.unit = "s",
            .range = above_zero(1e6),
            .meaning = "time that the learning of a tuned model may take; no round begins that would not end "
                       "in it",
            .source = "choice; measured: a left ventricle of 7366 tets takes 190 s to 1 % (cardiac reduce)",
            .used_with = "preset",
            .used_values = {"tuned"},
            .also = {reduced()}})
      .key(
          "affine_frames", &Reduction::affine_frames,
          {.meaning = "whether the affine functions of the control nodes stay unknowns beside the modes of a "
                      "tuned model: nearer in regions that it did not learn, at several times the cost",
           .source = "measured: cardiac bench",
           .used_with = "preset",
           .used_values = {"tuned"},
           .also = {reduced()}});
  return table.build();
}

KeyFacts of_law(std::string law, std::string unit, Range range, std::string meaning, std::string source) {
  KeyFacts facts;
  facts.unit = std::move(unit);
  facts.range = range;
  facts.meaning = std::move(meaning);
  facts.source = std::move(source);
  facts.used_with = "law";
  facts.used_values = {std::move(law)};
  return facts;
}

Table tissue_table() {
  const auto guccione = [](const char* unit, const char* meaning) {
    return of_law("guccione", unit, above_zero(1000), meaning,
                  "law Guccione 1991; value Land 2015, problem 3");
  };
  const auto ogden = [](const char* unit, double high, const char* meaning) {
    return of_law("holzapfel_ogden", unit, {0, high}, meaning,
                  "law Holzapfel & Ogden 2009; value Aróstica 2025");
  };
  TableBuilder table("tissue", "Passive law and viscosity of the muscle.", &Protocol::tissue);
  table
      .key("law", &Tissue::law,
           {.meaning = "passive law; guccione and holzapfel_ogden act on isochoric strains (I4, I8 of "
                       "holzapfel_ogden excepted), with a volumetric energy beside them",
            .source = "Guccione 1991; the law of protocols/healthy_lv.toml"})
      .key("C_kPa", &Tissue::C_kPa,
           guccione("kPa",
                    "C of W = C/2 (exp Q − 1), Q = bf E_ff² + bt (E_ss² + E_nn² "
                    "+ 2 E_sn²) + 2 bfs (E_fs² + E_fn²)"))
      .key("bf", &Tissue::bf, guccione("", "stiffness along the fibre in Q (see C_kPa)"))
      .key("bt", &Tissue::bt, guccione("", "stiffness across the fibre in Q (see C_kPa)"))
      .key("bfs", &Tissue::bfs,
           of_law(
               "guccione", "", above_zero(1000), "shear stiffness in Q (see C_kPa)",
               "law Guccione 1991; value chosen for the longitudinal strain of a healthy beat: GLS -13.7 %, "
               "with the 4 of Land 2015, problem 3, -13.0 %"))
      .key("a_kPa", &Tissue::a_kPa, ogden("kPa", 1000, "a of a/(2b) (exp(b (I1 − 3)) − 1)"))
      .key("b", &Tissue::b, ogden("", 200, "b of the isotropic term (see a_kPa)"))
      .key("a_f_kPa", &Tissue::a_f_kPa, ogden("kPa", 1000, "a_f of a_f/(2b_f) (exp(b_f (I4f − 1)²) − 1)"))
      .key("b_f", &Tissue::b_f, ogden("", 200, "b_f of the fibre term (see a_f_kPa)"))
      .key("a_s_kPa", &Tissue::a_s_kPa, ogden("kPa", 1000, "a_s of a_s/(2b_s) (exp(b_s (I4s − 1)²) − 1)"))
      .key("b_s", &Tissue::b_s, ogden("", 200, "b_s of the sheet term (see a_s_kPa)"))
      .key("a_fs_kPa", &Tissue::a_fs_kPa, ogden("kPa", 1000, "a_fs of a_fs/(2b_fs) (exp(b_fs I8fs²) − 1)"))
      .key("b_fs", &Tissue::b_fs, ogden("", 200, "b_fs of the fibre–sheet term (see a_fs_kPa)"))
      .key("mu_kPa", &Tissue::mu_kPa,
           of_law("neo_hookean", "kPa", above_zero(1e6), "shear modulus of W = µ/2 (I1 − 3), I1 isochoric",
                  "E = 10 kPa, ν = 0.49: µ = E/(2 (1 + ν))"))
      .key("c1_kPa", &Tissue::c1_kPa,
           of_law("mooney_rivlin", "kPa", above_zero(1e6), "c1 of W = c1 (I1 − 3) + c2 (I2 − 3), isochoric",
                  "2 (c1 + c2) = 3.4 kPa, as mu_kPa"))
      .key("c2_kPa", &Tissue::c2_kPa,
           of_law("mooney_rivlin", "kPa", {0, 1e6}, "c2 of W = c1 (I1 − 3) + c2 (I2 − 3), isochoric",
                  "2 (c1 + c2) = 3.4 kPa, as mu_kPa"))
      .key("youngs_modulus_kPa", &Tissue::youngs_modulus_kPa,
           of_law("saint_venant_kirchhoff", "kPa", above_zero(1e9), "Young's modulus",
                  "soft muscle, as mu_kPa"))
      .key("poisson_ratio", &Tissue::poisson_ratio,
           of_law("saint_venant_kirchhoff", "", {0, 0.4999}, "Poisson's ratio", "nearly incompressible"))
      .key("bulk_modulus_kPa", &Tissue::bulk_modulus_kPa,
           {.unit = "kPa",
            .range = above_zero(1e8),
            .meaning = "bulk modulus of the volumetric energy",
            .source = "measured: at end systole of a healthy beat every segment keeps 99 % of its volume "
                      "(muscle: within a few per cent, Yin, Chan & Judd 1996); with 1000 kPa 94 %",
            .used_with = "law",
            .used_values = {"guccione", "holzapfel_ogden", "neo_hookean", "mooney_rivlin"}})
      .key("viscosity_kPa_ms", &Tissue::viscosity_kPa_ms,
           {.unit = "kPa·ms",
            .range = {0, 1e5},
            .meaning = "viscosity η of the second Piola–Kirchhoff stress S = η dE/dt",
            .source = "Aróstica 2025: 100 Pa·s",
            .also = {contracts()}})
      .key("density_g_per_mL", &Tissue::density_mg_per_mm3,
           {.unit = "g/mL",
            .range = {0, 100},
            .meaning =
                "mass of the wall per volume, for its inertia; 0: the wall has none, as slow as a heart "
                "moves; muscle has 1.06",
            .source = "convention: nothing that is not asked for; Mendez & Keys 1960: 1.06",
            .also = {contracts()}});
  return table.build();
}

KeyFacts of_source(std::string source, std::string meaning, std::string absent) {
  KeyFacts facts;
  facts.meaning = std::move(meaning);
  facts.absent = std::move(absent);
  facts.used_with = "source";
  facts.used_values = {std::move(source)};
  return facts;
}

Table fibres_table() {
  KeyFacts sheet_array = of_source("file", "array of the mesh file with the sheet directions",
                                   "the usual names (sheet, s0, sheet_normal, n0, …), if there are any");
  sheet_array.also = {along_sheets()};
  const std::string healthy =
      "Streeter 1969: 60 and -60; 70 and -70 for the longitudinal strain of a healthy beat: GLS -13.7 %, "
      "with 60 "
      "-10.6 %";
  TableBuilder table("fibres", "Direction of the muscle fibres.", &Protocol::fibres);
  table
      .key("source", &Fibres::source,
           {.meaning = "rule: the directions of rule and its angles; file: those that the mesh file brings, "
                       "vectors of points or of tets, of any length and sign; without sheet directions the "
                       "sheet is the wall normal across the fibre",
            .source = "convention: few meshes bring fibres"})
      .key("fibre_array", &Fibres::fibre_array,
           of_source("file", "array of the mesh file with the fibre directions",
                     "the first of the usual names: fibre, fiber, f0, …"))
      .key("sheet_array", &Fibres::sheet_array, sheet_array)
      .key("rule", &Fibres::rule,
           {.meaning = "helix: the angle from the circumferential towards the longitudinal (base) direction "
                       "varies linearly through the depth of the wall",
            .source = "Bayer 2012; Streeter 1969",
            .used_with = "source",
            .used_values = {"rule"}})
      .key("endo_angle_deg", &Fibres::endo_angle_deg,
           {.unit = "deg",
            .range = {-90, 90},
            .meaning = "helix angle at the endocardium",
            .source = healthy,
            .used_with = "source",
            .used_values = {"rule"}})
      .key("epi_angle_deg", &Fibres::epi_angle_deg,
           {.unit = "deg",
            .range = {-90, 90},
            .meaning = "helix angle at the epicardium",
            .source = healthy,
            .used_with = "source",
            .used_values = {"rule"}})
      .key("sheet_angle_deg", &Fibres::sheet_angle_deg,
           {.unit = "deg",
            .range = {-90, 90},
            .meaning = "angle of the sheet direction from the wall normal, about the fibre",
            .source = "convention: sheets along the wall normal",
            .used_with = "source",
            .used_values = {"rule"},
            .also = {along_sheets()}})
      .key("rv_endo_angle_deg", &Fibres::rv_endo_angle_deg,
           {.unit = "deg",
            .range = {-180, 180},
            .meaning = "helix angle at the endocardium of the right free wall",
            .source = healthy,
            .used_with = "source",
            .used_values = {"rule"},
            .also = {two_ventricles()}})
      .key(
          "rv_epi_angle_deg", &Fibres::rv_epi_angle_deg,
          {.unit = "deg",
           .range = {-180, 180},
           .meaning = "helix angle at the epicardium of the right free wall; -60 and 120 are the same fibre, "
                      "to which the angle turns through circumferential or through longitudinal fibres",
           .source = healthy,
           .used_with = "source",
           .used_values = {"rule"},
           .also = {two_ventricles()}});
  table.all(along_fibres());
  return table.build();
}

}  // namespace

std::vector<Table> model_tables() {
  return {reduction_table(), tissue_table(), fibres_table()};
}

}  // namespace cardiac::protocol
