#include <cardiac/report/page_numbers.hpp>

#include <cmath>
#include <vector>

#include <cardiac/report/haemodynamics_text.hpp>
#include <cardiac/report/normal_values.hpp>
#include <cardiac/report/page_parts.hpp>
#include <cardiac/report/tables.hpp>
#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

std::string healthy(Measured quantity) {
  return "healthy adults " + normal_value(quantity).range();
}

std::string ventricle_title(const VentricleSummary& v) {
  return v.name == "lv" ? "Left ventricle" : v.name == "rv" ? "Right ventricle" : v.name;
}

std::string circulation_cards(const VentricleSummary& v) {
  if (!v.haemodynamics) return "";
  const Haemodynamics& h = *v.haemodynamics;
  return number_card("Cardiac output", display_text(h.cardiac_output_L_per_min, 1), "L/min") +
         number_card(
             v.name == "rv" ? "Pulmonary artery pressure" : "Aortic pressure",
             display_text(h.arterial_systolic_mmHg, 0) + "/" + display_text(h.arterial_diastolic_mmHg, 0),
             "mmHg", "mean " + display_text(h.arterial_mean_mmHg, 0)) +
         number_card("Stroke work", display_text(h.stroke_work_mJ, 0), "mJ") +
         number_card("dP/dt", display_text(h.dp_dt_max_mmHg_per_s, 0), "mmHg/s",
                     "lowest " + display_text(h.dp_dt_min_mmHg_per_s, 0));
}

/// Leaks, and what end diastole and end systole are.
std::string ventricle_words(const VentricleSummary& v) {
  std::string html;
  const std::vector<std::string> lines = haemodynamics_lines(v);
  for (std::size_t k = 1; k < lines.size(); ++k)
    html += "<p class=\"small\">" + escape_markup(lines[k]) + "</p>\n";
  if (!v.ed_is.empty() && !v.es_is.empty())
    html += "<p class=\"small\">End diastole: " + escape_markup(v.ed_is) + ", at " +
            display_text(v.ed_time_ms, 0) + " ms. End systole: " + escape_markup(v.es_is) + ", at " +
            display_text(v.es_time_ms, 0) + " ms.</p>\n";
  return html;
}

std::string ventricle_cards(const VentricleSummary& v, bool has_beat) {
  if (!has_beat) {
    if (v.samples.empty()) return "";
    return number_card("Volume at the end", display_text(v.samples.back().volume_mL, 1), "mL") +
           number_card("Pressure at the end", display_text(v.samples.back().pressure_mmHg, 1), "mmHg") +
           number_card("Volume at the start", display_text(v.samples.front().volume_mL, 1), "mL");
  }
  const bool left = v.name == "lv", right = v.name == "rv";
  const auto note = [&](Measured of_left) { return left ? healthy(of_left) : ""; };
  const auto note_of_both = [&](Measured of_left, Measured of_right) {
    return left ? healthy(of_left) : right ? healthy(of_right) : "";
  };
  return number_card("End-diastolic volume", display_text(v.edv_mL, 1), "mL", note(Measured::lv_edv)) +
         number_card("End-systolic volume", display_text(v.esv_mL, 1), "mL", note(Measured::lv_esv)) +
         number_card("Stroke volume", display_text(v.sv_mL, 1), "mL") +
         number_card("Ejection fraction", display_text(v.ef_percent, 1), "%",
                     note_of_both(Measured::lv_ef, Measured::rv_ef)) +
         number_card("Peak pressure", display_text(v.peak_pressure_mmHg, 1), "mmHg",
                     note_of_both(Measured::lv_peak_pressure, Measured::rv_peak_pressure)) +
         number_card("End-diastolic pressure", display_text(v.edp_mmHg, 1), "mmHg") + circulation_cards(v);
}

std::string strain_cards(const BeatResult& r) {
  const auto note = [&r](Measured quantity) { return r.has_beat ? healthy(quantity) : ""; };
  return "<h3>Global strain of the left ventricle at " +
         std::string(has_systole(r) ? "end systole, against end diastole" : "the end, against the start") +
         "</h3>\n<div class=\"cards\">\n" +
         number_card("Longitudinal (GLS)", display_text(r.strain.gls_percent, 1), "%", note(Measured::gls)) +
         number_card("Circumferential (GCS)", display_text(r.strain.gcs_percent, 1), "%",
                     note(Measured::gcs)) +
         number_card("Radial (GRS)", display_text(r.strain.grs_percent, 1), "%", note(Measured::grs)) +
         number_card("Twist", display_text(r.strain.twist_deg, 1), "°", note(Measured::twist)) + "</div>\n";
}

std::string right_strain_cards(const BeatResult& r) {
  if (!r.right_strain) return "";
  const GlobalStrain& strain = *r.right_strain;
  return "<h3>Global strain of the right free wall at the same time</h3>\n<div class=\"cards\">\n" +
         number_card("Longitudinal (GLS)", display_text(strain.gls_percent, 1), "%",
                     r.has_beat ? healthy(Measured::rv_gls) : "") +
         number_card("Circumferential (GCS)", display_text(strain.gcs_percent, 1), "%") +
         number_card("Radial (GRS)", display_text(strain.grs_percent, 1), "%") + "</div>\n";
}

std::string what_a_mean_is() {
  return "<p class=\"small\"><strong>GLS, GCS and GRS are means of the local strain over the volume of the "
         "wall</strong>, weighted by the volume of each segment. Clinics measure along contours drawn in "
         "images, mostly of the endocardium, which shortens more than the rest of the wall: the two are "
         "different numbers of the same beat, and published values are of contours. Twist is the rotation of "
         "the apical segments minus that of the basal ones, positive when the apex turns counter-clockwise "
         "seen from the apex.</p>\n";
}

/// Strain of one ventricle and direction, as a mean and along contours, percent.
struct ContourRow {
  std::string name;
  double mean;
  LayerStrain contours;
};

std::string contour_table(const BeatResult& r) {
  std::vector<ContourRow> rows{
      {"Longitudinal, left ventricle", r.strain.gls_percent, r.strain.longitudinal},
      {"Circumferential, left ventricle", r.strain.gcs_percent, r.strain.circumferential}};
  if (r.right_strain)
    rows.push_back(
        {"Longitudinal, right free wall", r.right_strain->gls_percent, r.right_strain->longitudinal});
  std::string html =
      "<h3>The same along contours, as clinics measure it</h3>\n<div class=\"wide\"><table><thead><tr>"
      "<th class=\"left\">Global strain, %</th><th>mean over the wall</th><th>endocardial contour</th>"
      "<th>mid-wall contour</th><th>epicardial contour</th></tr></thead><tbody>\n";
  for (const ContourRow& row : rows)
    html += "<tr>" + table_cell(row.name, "left") + table_cell(display_text(row.mean, 1)) +
            table_cell(display_text(row.contours.endocardial_percent, 1)) +
            table_cell(display_text(row.contours.midwall_percent, 1)) +
            table_cell(display_text(row.contours.epicardial_percent, 1)) + "</tr>\n";
  const auto thickening = [](const std::string& name, const GlobalStrain& strain) {
    const double thicker = strain.wall_thickening_percent, closer = strain.base_excursion_mm;
    return "The " + name + (thicker < 0 ? " thins by " : " thickens by ") +
           display_text(std::abs(thicker), 1) + " % (its volume over its area), its base comes " +
           display_text(std::abs(closer), 1) + (closer < 0 ? " mm farther from" : " mm closer to") +
           " the apex. ";
  };
  return html + "</tbody></table></div>\n<p class=\"small\">" +
         thickening("wall of the left ventricle", r.strain) +
         (r.right_strain ? thickening("right free wall", *r.right_strain) : "") +
         "Over time in global_strain.csv.</p>\n";
}

struct Row {
  Measured quantity;
  std::string of;
  double value;
  double contour = NAN;  ///< the same along the endocardium; of radial strain the wall's thickening
};

std::vector<Row> rows_of(const BeatResult& r) {
  std::vector<Row> rows;
  for (const VentricleSummary& v : r.ventricles) {
    if (v.name == "lv") {
      rows.push_back({Measured::lv_edv, "left ventricle", v.edv_mL});
      rows.push_back({Measured::lv_esv, "left ventricle", v.esv_mL});
      rows.push_back({Measured::lv_ef, "left ventricle", v.ef_percent});
      rows.push_back({Measured::lv_peak_pressure, "left ventricle", v.peak_pressure_mmHg});
    } else if (v.name == "rv") {
      rows.push_back({Measured::rv_ef, "right ventricle", v.ef_percent});
      rows.push_back({Measured::rv_peak_pressure, "right ventricle", v.peak_pressure_mmHg});
    }
  }
  if (r.instants.empty()) return rows;
  rows.push_back(
      {Measured::gls, "left ventricle", r.strain.gls_percent, r.strain.longitudinal.endocardial_percent});
  rows.push_back(
      {Measured::gcs, "left ventricle", r.strain.gcs_percent, r.strain.circumferential.endocardial_percent});
  rows.push_back({Measured::grs, "left ventricle", r.strain.grs_percent, r.strain.wall_thickening_percent});
  rows.push_back({Measured::twist, "left ventricle", r.strain.twist_deg});
  if (r.right_strain)
    rows.push_back({Measured::rv_gls, "right free wall", r.right_strain->gls_percent,
                    r.right_strain->longitudinal.endocardial_percent});
  return rows;
}

std::string normal_table(const BeatResult& r) {
  std::string rows;
  for (const Row& row : rows_of(r)) {
    const NormalValue& normal = normal_value(row.quantity);
    std::string published;
    for (const PublishedValue& p : normal.published)
      published += (published.empty() ? "" : "<br>") + escape_markup(p.text) + " <span class=\"source\">" +
                   escape_markup(p.source) + "</span>";
    rows +=
        "<tr>" + table_cell(normal.name + ", " + row.of, "left") +
        table_cell(display_text(row.value, 1) + "\u00a0" + normal.unit) +
        table_cell(std::isfinite(row.contour) ? display_text(row.contour, 1) + "\u00a0" + normal.unit : "") +
        // Published strains are of contours: like stands beside like.
        table_cell(normal.place_of(std::isfinite(row.contour) ? row.contour : row.value), "left") +
        "<td class=\"text\">" + published + "</td></tr>\n";
  }
  if (rows.empty()) return "";
  return "<h2>Beside what is published of healthy adults</h2>\n<div class=\"wide\"><table><thead><tr>"
         "<th class=\"left\">Quantity</th><th>This beat</th><th>along contours</th><th class=\"left\"></th>"
         "<th class=\"left\">Healthy adults, and where that is from</th></tr></thead><tbody>\n" +
         rows +
         "</tbody></table></div>\n<p class=\"small\">Along contours: the endocardial contour, of radial "
         "strain the "
         "thickening of the wall. The word beside compares that number where there is one.</p>\n";
}

}  // namespace

std::string numbers_section(const BeatResult& r) {
  std::string html = "<h2>Headline numbers</h2>\n";
  for (const VentricleSummary& v : r.ventricles)
    html += "<h3>" + escape_markup(ventricle_title(v)) + "</h3>\n<div class=\"cards\">\n" +
            ventricle_cards(v, r.has_beat) + "</div>\n" + ventricle_words(v);
  if (r.instants.empty())
    html += "<p>No strain was computed.</p>\n";
  else
    html += strain_cards(r) + right_strain_cards(r) + what_a_mean_is() + contour_table(r);
  return html + (r.has_beat ? normal_table(r) : "");
}

}  // namespace cardiac
