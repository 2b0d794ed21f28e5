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
