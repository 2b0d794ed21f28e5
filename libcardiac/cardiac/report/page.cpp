#include <cardiac/report/page.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include <cardiac/report/figures.hpp>
#include <cardiac/report/filling.hpp>
#include <cardiac/report/page_numbers.hpp>
#include <cardiac/report/page_parts.hpp>
#include <cardiac/report/page_style.hpp>
#include <cardiac/report/protocol_facts.hpp>
#include <cardiac/report/tables.hpp>
#include <cardiac/report/text.hpp>
#include <cardiac/strain/peaks.hpp>
#include <polyaffine/core/atomic_file.hpp>

namespace cardiac {
namespace {

std::string count_text(long long count) {
  std::string text = std::to_string(count);
  for (int i = static_cast<int>(text.size()) - 3; i > (count < 0 ? 1 : 0); i -= 3)
    text.insert(static_cast<size_t>(i), "\u202f");
  return text;
}

std::string method_name(const BeatResult& r) {
  if (r.method == "polyaffine") return "reduced (poly-affine)";
  if (r.method == "fem") return "full order (finite elements)";
  return r.method;
}

std::string alerts(const BeatResult& r) {
  std::string html;
  if (!r.completed) {
    html += "<div class=\"alert stop\" role=\"alert\"><strong>This run did not complete</strong>" +
            escape_markup(r.stop_reason.empty() ? "No reason was given." : r.stop_reason) +
            "<br>It reached " + display_text(r.simulated_time_s, 3) +
            " s of simulated time; what follows is what it had.</div>\n";
  }
  if (!r.warnings.empty()) {
    html +=
        "<div class=\"alert\"><strong>" +
        std::string(r.warnings.size() == 1 ? "A warning" : std::to_string(r.warnings.size()) + " warnings") +
        "</strong><ul>";
    for (const std::string& warning : r.warnings) html += "<li>" + escape_markup(warning) + "</li>";
    html += "</ul></div>\n";
  }
  return html;
}

std::string figure_html(const Figure& figure) {
  return "<figure>" + figure.svg + "</figure>\n";
}

std::string group(const std::string& title, const std::string& text, const char* layout,
                  const std::string& figures) {
  if (figures.empty()) return "";
  return "<h2>" + title + "</h2>\n" + (text.empty() ? "" : "<p class=\"small\">" + text + "</p>\n") +
         "<div class=\"" + layout + "\">\n" + figures + "</div>\n";
}

std::string activation_sentence(const BeatResult& r) {
  const auto span = activation_span(r);
  if (!span) return "";
  if (span->uniform()) return "Every segment is activated at " + display_text(span->first_ms, 0) + " ms.";
  return "The segments are activated from " + display_text(span->first_ms, 0) + " to " +
         display_text(span->last_ms, 0) + " ms.";
}

std::string figure_sections(const BeatResult& r, const RunInfo& info, const std::string& wall_svg) {
  std::string courses, curves, eyes, peaks, right, filling;
  for (const Figure& figure : figures(r, info)) {
    const bool eye = figure.file.starts_with("bullseye_");
    std::string& of = figure.file.starts_with("bullseye_peak_")    ? peaks
                      : figure.file.starts_with("bullseye_right_") ? right
                      : eye                                        ? eyes
                      : figure.file == "filling.svg"               ? filling
                      : figure.file.starts_with("strain_curves")   ? curves
                                                                   : courses;
    of += figure_html(figure);
  }
  std::string html;
  if (!wall_svg.empty())
    html += "<h2>The wall " +
            std::string(has_systole(r) ? "at end diastole and end systole" : "before and after") + "</h2>\n" +
            figure_html({"wall.svg", wall_svg});
  const std::string when = r.has_beat ? "over the last beat" : "over the loading";
  return html + group("Pressure and volume " + when, "", "pair", courses) +
         group("Segments of the left ventricle " +
                   std::string(has_systole(r) ? "at end systole" : "at the end"),
               activation_sentence(r), "eyes", eyes) +
         group("Segments of the right ventricle", "The free wall laid out flat beside the septum.", "eyes",
               right) +
         group("Peak strain of the segments",
               "The strongest shortening (radial: thickening) at any time. A segment that is stretched in "
               "systole "
               "and shortens a little afterwards shows that little here: read it beside end systole.",
               "eyes", peaks) +
         group("Strain " + when, "", "full", curves) +
         group("The unloaded heart", r.unloading ? "The mesh is " + unloading_text(*r.unloading) + "." : "",
               "full", filling);
}

std::string segment_table_head(bool has_systole) {
  const std::string span = has_systole ? "4" : "3", end = has_systole ? "ES" : "end";
  std::string names, columns;
  for (const char* strain : {"Longitudinal", "Circumferential", "Radial"}) {
    names += "<th colspan=\"" + span + "\" class=\"group\">" + strain + "</th>";
    columns += "<th class=\"group\">" + end + "<br>%</th><th>peak<br>%</th><th>at<br>ms</th>";
    if (has_systole) columns += "<th>PSI<br>%</th>";
  }
  return "<thead><tr><th rowspan=\"2\">No.</th><th rowspan=\"2\" class=\"left\">Segment</th>"
         "<th rowspan=\"2\">Volume<br>mL</th>" +
         names + "</tr><tr>" + columns + "</tr></thead>";
}

/// " (A)" for each region that the segment belongs to.
std::string letters_of(int segment, const std::vector<NamedRegion>& regions) {
  std::string text;
  for (size_t i = 0; i < regions.size(); ++i)
    if (std::ranges::find(regions[i].segments, segment) != regions[i].segments.end())
      text += std::string(" (") + region_letter(i) + ")";
  return text;
}

std::string segment_table(const BeatResult& r, const RunInfo& info) {
  const auto [ed_ms, es_ms] = cardiac_times(r);
  const std::vector<SegmentPeaks> peaks = strain_peaks(r.instants, ed_ms, es_ms);
  if (peaks.empty()) return "";
  const std::vector<NamedRegion> regions = regions_of(info.protocol_json);
  std::string rows, names;
  for (size_t i = 0; i < regions.size(); ++i)
    names += std::string(" (") + region_letter(i) + ") " + escape_markup(regions[i].name) + ".";
  for (size_t i = 0; i < peaks.size(); ++i) {
    const SegmentInfo& segment = r.segments.at(i);
    rows += "<tr>" + table_cell(std::to_string(segment.number)) +
            table_cell(segment.name + letters_of(segment.number, regions), "left") +
            table_cell(display_text(segment.volume_mL, 1));
    for (const StrainPeak& p : {peaks[i].longitudinal, peaks[i].circumferential, peaks[i].radial}) {
      rows += table_cell(display_text(100 * p.end_systolic, 1), "group") +
              table_cell(display_text(100 * p.value, 1)) + table_cell(display_text(p.time_ms, 0));
      if (has_systole(r)) rows += table_cell(display_text(p.post_systolic_index_percent, 0));
    }
    rows += "</tr>\n";
  }
  return "<h2>Table of the segments</h2>\n<div class=\"wide\"><table>" + segment_table_head(has_systole(r)) +
         "<tbody>\n" + rows + "</tbody></table></div>\n<p class=\"small\">Lagrangian strain against " +
         (has_systole(r) ? "end diastole" : "the start") +
         ", averaged over the segment in its local axes. Peak: strongest shortening (longitudinal, "
         "circumferential) or thickening (radial) over all times; a segment that only lengthens or thins has "
         "its strongest lengthening or thinning, with that sign." +
         (has_systole(r)
              ? " PSI: post-systolic index, 100 (peak − ES)/peak where the peak comes outside of "
                "systole, otherwise 0; left open where peak and ES differ in sign, or where a late "
                "peak follows less than " +
                    display_text(100 * kLeastEndSystolicStrain, 0) +
                    " % at ES: the quotient would compare unlike things."
              : "") +
         names + "</p>\n";
}

std::string assumptions_section(const BeatResult& r, const RunInfo& info) {
  const bool right = std::ranges::any_of(r.ventricles, [](const auto& v) { return v.name == "rv"; });
  std::string html = "<h2>What was taken for granted</h2>\n<ul class=\"assumptions\">\n";
  for (const std::string& sentence : assumptions_of(info.protocol_json, right))
    html += "<li>" + escape_markup(sentence) + "</li>\n";
  return html + "</ul>\n";
}

std::string plan_section(const BeatResult& r) {
  if (r.plan.empty()) return "";
  std::string html =
      "<h2>The plan: what was built and what was left out</h2>\n<div class=\"wide\"><table><thead><tr>"
      "<th class=\"left\">Part</th><th class=\"left\">Built</th><th "
      "class=\"left\">Why</th></tr></thead><tbody>\n";
  for (const PlanItem& item : r.plan)
    html += "<tr>" + table_cell(item.part, "left") +
            (item.built ? "<td class=\"left yes\">built</td>" : "<td class=\"left no\">left out</td>") +
            table_cell(item.why, "text") + "</tr>\n";
  return html + "</tbody></table></div>\n";
}

std::string verification_section(const BeatResult& r) {
  if (r.verification.empty()) return "";
  std::string html =
      "<h2>Verification against full order</h2>\n<div class=\"wide\"><table><thead><tr><th "
      "class=\"left\">Instant"
      "</th><th>Time<br>ms</th><th>Displacement error<br>%</th><th>Volume error<br>%</th><th>Largest segment "
      "strain error</th><th>Wall time<br>s</th></tr></thead><tbody>\n";
  for (const VerificationInstant& v : r.verification)
    html += "<tr>" + table_cell(v.instant, "left") + table_cell(display_text(v.time_ms, 0)) +
            table_cell(display_text(v.displacement_error_percent, 2)) +
            table_cell(display_text(v.volume_error_percent, 2)) +
            table_cell(display_text(v.max_segment_strain_error, 4)) +
            table_cell(display_text(v.wall_time_s, 2)) + "</tr>\n";
  return html + "</tbody></table></div>\n";
}

std::string run_section(const BeatResult& r, const RunInfo& info) {
  std::string rows;
  const auto row = [&rows](const std::string& name, const std::string& value) {
    rows += "<tr>" + table_cell(name, "left") + table_cell(value, "left") + "</tr>\n";
  };
  row("Method", method_name(r));
  row("Shape of the mesh", r.unloading ? unloading_text(*r.unloading) : "taken as free of stress (unloaded)");
  row("Mesh", count_text(r.mesh_vertices) + " vertices, " + count_text(r.mesh_tets) + " tetrahedra");
  row("Unknowns", count_text(r.dofs));
  if (r.control_nodes > 0) row("Control nodes", count_text(r.control_nodes));
  row("Integration points", count_text(r.integration_points));
  if (r.has_beat) row("Beats", count_text(r.beats));
  row("Time steps", count_text(r.time_steps));
  row("Newton iterations", count_text(r.newton_iterations));
  row("det F, smallest to largest", display_text(r.min_det_F, 3) + " to " + display_text(r.max_det_F, 3));
  row("Simulated time", display_text(r.simulated_time_s, 3) + " s");
  row("Set-up", display_text(r.wall_setup_s, 2) + " s");
  row("Solution", display_text(r.wall_solve_s, 2) + " s");
  row("Output", display_text(r.wall_output_s, 2) + " s");
  row("Total run time", display_text(r.wall_total_s, 2) + " s");
  row("Real-time factor (below 1: faster than the heart)",
      display_text(r.wall_solve_s / r.simulated_time_s, 2));
  row("Seed", std::to_string(info.seed));
  return "<h2>Mesh, method and run time</h2>\n<div class=\"wide\"><table class=\"facts\"><tbody>\n" + rows +
         "</tbody></table></div>\n";
}

std::string protocol_section(const RunInfo& info) {
  using Json = nlohmann::ordered_json;
  const Json protocol = Json::parse(info.protocol_json, nullptr, false);
  const std::string text = protocol.is_discarded()
                               ? info.protocol_json
                               : protocol.dump(2, ' ', false, Json::error_handler_t::replace);
  return "<details><summary>The protocol as resolved, every default filled in</summary><pre>" +
         escape_markup(text) + "</pre></details>\n";
}

std::string folder_title(const std::filesystem::path& out) {
  const std::filesystem::path whole = std::filesystem::absolute(out).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

}  // namespace

std::string report_page(const BeatResult& r, const RunInfo& info, const std::string& title,
                        const std::string& wall_svg) {
  const std::string name = escape_markup(title), version = escape_markup(info.version);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         name + " – cardiac report</title>\n<style>" + std::string(kPageStyle) +
         "</style>\n</head>\n<body>\n<header>\n<h1>" + name + "</h1>\n<p class=\"sub\">" +
         (r.has_beat ? "Heart beat" : "Prescribed loading") + ", " + escape_markup(method_name(r)) +
         ", cardiac " + version + "</p>\n" + alerts(r) + "</header>\n<main>\n" + numbers_section(r) +
         figure_sections(r, info, wall_svg) + segment_table(r, info) + assumptions_section(r, info) +
         verification_section(r) + plan_section(r) + run_section(r, info) + protocol_section(info) +
         "</main>\n<footer>Written by cardiac " + version +
         ". A model, not a measurement: not for diagnosis.</footer>\n</body>\n</html>\n";
}

void write_report_page(const BeatResult& result, const RunInfo& info, const std::filesystem::path& out,
                       const std::string& wall_svg) {
  polyaffine::make_folder(out);
  polyaffine::write_atomically(out / "report.html", report_page(result, info, folder_title(out), wall_svg));
}

}  // namespace cardiac
