#include <cardiac/bench/bench_table.hpp>

#include <limits>

#include <cardiac/report/csv_writer.hpp>
#include <cardiac/report/text.hpp>

namespace cardiac {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void add_row(const BenchRow& row, CsvWriter& csv) {
  const auto known = [&](double value) { return row.converged ? value : kNone; };
  const BeatErrors beat = row.beat.value_or(BeatErrors{kNone, kNone, kNone, kNone, kNone});
  csv << row.scene << row.method << row.preset << row.mesh_tets << row.control_nodes << row.dofs
      << row.integration_points << row.setup_s << row.solve_s << known(row.cavity_ratio)
      << known(row.errors.displacement_percent) << known(row.errors.volume_percent)
      << known(row.errors.max_segment_strain) << known(row.errors.apex_strain) << row.speedup_over_fem
      << row.integration << known(row.errors.compliance_ratio) << row.load_steps << row.newton_iterations
      << (row.converged ? "yes" : "no");
  csv.quoted(row.settings) << beat.ef_points << beat.gls_points << beat.peak_strain << beat.apex_peak_strain
                           << beat.real_time_factor << row.setup_full_order_solves
                           << known(row.errors.rv_volume_percent) << known(row.errors.right_strain)
                           << row.heart << row.break_even_solves;
  const ModelErrors same =
      row.converged && row.same_tets ? *row.same_tets : ModelErrors{kNone, kNone, kNone, kNone, kNone};
  csv << same.displacement_percent << same.volume_percent << same.max_segment_strain;
  csv.end_row();
}

std::string cell(double value, int decimals) {
  return " " + display_text(value, decimals) + " |";
}

std::string markdown_row(const BenchRow& row) {
  const auto known = [&](double value) { return row.converged ? value : kNone; };
  std::string out = "| " + row.method + " | " + row.preset + " | " + row.integration + " |";
  for (const int count : {row.mesh_tets, row.control_nodes, row.dofs, row.integration_points})
    out += " " + std::to_string(count) + " |";
  return out + cell(row.setup_s, 2) + cell(row.solve_s, 3) + cell(known(row.errors.displacement_percent), 2) +
         cell(known(row.errors.volume_percent), 2) + cell(known(row.errors.max_segment_strain), 4) +
         cell(known(row.errors.apex_strain), 4) + cell(known(row.errors.compliance_ratio), 4) +
         cell(row.speedup_over_fem, 1) +
         cell(row.same_tets ? row.same_tets->displacement_percent : kNone, 2) + " " + row.settings + " |\n";
}

// The fastest reduced model whose displacement error is no larger than that of a full-order one.
const BenchRow* fastest_as_accurate(const std::vector<BenchRow>& rows, const BenchRow& full) {
  const BenchRow* out = nullptr;
  for (const BenchRow& row : rows)
    if (row.method == "polyaffine" && row.converged &&
        row.errors.displacement_percent <= full.errors.displacement_percent &&
        (out == nullptr || row.solve_s < out->solve_s))
      out = &row;
  return out;
}

// A line for each quadratic mesh but the reference, which is the first row.
std::string comparison(const std::vector<BenchRow>& rows) {
  std::string out;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const BenchRow& full = rows[k];
    if (full.method != "fem_p2" || !full.converged || full.beat) continue;
    out += "\n- " + std::to_string(full.mesh_tets) + " quadratic tets, " +
           display_text(full.errors.displacement_percent, 2) + " %: ";
    const BenchRow* reduced = fastest_as_accurate(rows, full);
    out += reduced == nullptr ? "no reduced model is as accurate"
                              : "the fastest reduced model of no larger error (" + reduced->preset + ", " +
                                    std::to_string(reduced->control_nodes) + " nodes, " +
                                    display_text(reduced->errors.displacement_percent, 2) + " %) is " +
                                    display_text(full.solve_s / reduced->solve_s, 1) + " times faster";
  }
  return out.empty() ? out : out + "\n";
}

}  // namespace

std::string bench_csv(const std::vector<SceneResult>& results) {
  std::string notes =
      "# One thread; times are processor time of this run. setup_s: from the mesh to the model ready to "
      "solve; "
      "solve_s: all loads from zero, median of repeated short solves.\n"
      "# Errors against the finest full-order solution of the scene, at its integration points: displacement "
      "relative L2, cavity volume, Green-Lagrange normal strains averaged over segments (1-16, apex 17).\n";
  notes += "# same_tets_...: against quadratic elements on the same tets.\n";
  for (const SceneResult& r : results) notes += "# reference of " + r.scene + ": " + r.reference + "\n";
  CsvWriter csv(
      notes +
      "scene,method,preset,mesh_tets,control_nodes,dofs,integration_points,setup_s,solve_s,cavity_ratio,"
      "displacement_error_percent,volume_error_percent,max_segment_strain_error,apex_strain_error,"
      "speedup_over_fem,integration,compliance_ratio,load_steps,newton_iterations,converged,settings,"
      "ef_error_points,gls_error_points,peak_strain_error,apex_peak_strain_error,real_time_factor,"
      "setup_full_order_solves,rv_volume_error_percent,right_strain_error,heart,break_even_solves,"
      "same_tets_displacement_error_percent,same_tets_volume_error_percent,same_tets_max_segment_strain_"
      "error");
  for (const SceneResult& r : results)
    for (const BenchRow& row : r.rows) add_row(row, csv);
  return csv.text();
}

std::string bench_markdown(const std::vector<SceneResult>& results) {
  std::string out;
  for (const SceneResult& r : results) {
    out += "### " + r.title + " (`" + r.scene + "`)\n\nErrors against " + r.reference +
           ".\n\n| method | preset | integration | tets | nodes | unknowns | points | setup s | solve s | "
           "displacement % | volume % | segment strain | apex strain | compliance | × faster than P2 | "
           "displacement % against P2 on the same tets | settings |\n"
           "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const BenchRow& row : r.rows) out += markdown_row(row);
    out += comparison(r.rows);
    for (const BenchRow& row : r.rows)
      if (row.beat)
        out += "\n" + row.method + " " + row.preset + ": ejection fraction " +
               display_text(row.beat->ef_points, 2) + " points, GLS " +
               display_text(row.beat->gls_points, 2) + " points, worst segment peak " +
               display_text(row.beat->peak_strain, 4) + " (apex cap " +
               display_text(row.beat->apex_peak_strain, 4) + "), real-time factor " +
               display_text(row.beat->real_time_factor, 3) + ".\n";
    out += "\n";
  }
  return out;
}

}  // namespace cardiac
