#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include <cardiac/bench/bench_figure.hpp>
#include <cardiac/bench/bench_table.hpp>

namespace cardiac {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<SceneResult> two_rows() {
  BenchRow reference;
  reference.scene = "ellipsoid_passive";
  reference.method = "fem_p2";
  reference.mesh_tets = 2000;
  reference.dofs = 10101;
  reference.integration_points = 16000;
  reference.setup_s = 0.5;
  reference.solve_s = 8;
  reference.cavity_ratio = 1.87;
  reference.errors.compliance_ratio = 1;
  reference.speedup_over_fem = 1;
  reference.converged = true;
  BenchRow reduced = reference;
  reduced.method = "polyaffine";
  reduced.preset = "fast";
  reduced.integration = "cells";
  reduced.control_nodes = 17;
  reduced.dofs = 264;
  reduced.integration_points = 1320;
  reduced.solve_s = 0.25;
  reduced.errors = {6.5, -1.75, 0.03, 0.02, 0.96};
  reduced.speedup_over_fem = 32;
  return {{"ellipsoid_passive", "Passive inflation", "fem_p2 on 2000 tets", {reference, reduced}}};
}

std::string line_after(const std::string& text, const std::string& start) {
  const auto from = text.find(start);
  return text.substr(from, text.find('\n', from) - from);
}

TEST(BenchTable, HasTheColumnsOfTheInterfaceFirst) {
  const std::string csv = bench_csv(two_rows());
  EXPECT_THAT(csv, StartsWith("# One thread"));
  EXPECT_THAT(csv, HasSubstr("\n# reference of ellipsoid_passive: fem_p2 on 2000 tets\n"));
  const std::string header = line_after(csv, "scene,method");
  EXPECT_THAT(header,
              StartsWith("scene,method,preset,mesh_tets,control_nodes,dofs,integration_points,setup_s,"
                         "solve_s,cavity_ratio,displacement_error_percent,volume_error_percent,"
                         "max_segment_strain_error,apex_strain_error,speedup_over_fem"));
  const std::string row = line_after(csv, "ellipsoid_passive,polyaffine");
  EXPECT_THAT(row,
              StartsWith("ellipsoid_passive,polyaffine,fast,2000,17,264,1320,0.5,0.25,1.87,6.5,-1.75,0.03,"
                         "0.02,32,cells,"));
  EXPECT_EQ(std::ranges::count(row, ','), std::ranges::count(header, ','));
}

TEST(BenchTable, LeavesWhatDidNotConvergeWithoutErrors) {
  auto results = two_rows();
  results[0].rows[1].converged = false;
  results[0].rows[1].speedup_over_fem = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(line_after(bench_csv(results), "ellipsoid_passive,polyaffine"),
              StartsWith("ellipsoid_passive,polyaffine,fast,2000,17,264,1320,0.5,0.25,,,,,,,cells,"));
}

TEST(BenchTable, QuotesSettings) {
  auto results = two_rows();
  results[0].rows[1].settings = "reduction.enrichment=[\"tt\"]";
  EXPECT_THAT(bench_csv(results), HasSubstr(",\"reduction.enrichment=[\"\"tt\"\"]\",,,,,,0,,,,,,,\n"));
}

TEST(BenchMarkdown, HasARowAModelAsWideAsItsHeader) {
  const std::string text = bench_markdown(two_rows());
  const auto cells = [&](const std::string& start) {
    const std::string line = line_after(text, start);
    return std::ranges::count(line, '|');
  };
  EXPECT_EQ(cells("| method"), cells("|---"));
  EXPECT_EQ(cells("| method"), cells("| fem_p2"));
  EXPECT_EQ(cells("| method"), cells("| polyaffine"));
}

TEST(BenchMarkdown, ComparesWithTheFastestReducedModelThatIsAsAccurate) {
  auto results = two_rows();
  auto& rows = results[0].rows;
  BenchRow coarse = rows[0], finer = rows[0], slow = rows[1], enriched = rows[1];
  coarse.mesh_tets = 168;
  coarse.solve_s = 0.5;
  coarse.errors.displacement_percent = 7;
  finer.mesh_tets = 396;
  finer.errors.displacement_percent = 2;
  slow.control_nodes = 29;
  slow.solve_s = 1;
  slow.errors.displacement_percent = 3;
  enriched.solve_s = 0.1;
  enriched.errors.displacement_percent = 1;
  enriched.converged = false;
  rows.insert(rows.end(), {coarse, finer, slow, enriched});
  const std::string text = bench_markdown(results);
  EXPECT_THAT(text,
              HasSubstr("- 168 quadratic tets, 7.00 %: the fastest reduced model of no larger error (fast, "
                        "17 nodes, 6.50 %) is 2.0 times faster\n"));
  EXPECT_THAT(text, HasSubstr("- 396 quadratic tets, 2.00 %: no reduced model is as accurate\n"));
  EXPECT_THAT(text, Not(HasSubstr("- 2000 quadratic")));
}

TEST(BenchFigure, MarksModelsAndNotTheReference) {
  auto results = two_rows();
  EXPECT_THAT(bench_svg(results), Not(HasSubstr("Passive inflation")));  // one model makes no front
  auto& rows = results[0].rows;
  for (const int nodes : {5, 29, 61}) {
    rows.push_back(BenchRow(rows[1]));
    rows.back().control_nodes = nodes;
  }
  rows.push_back(BenchRow(rows[1]));
  rows.back().dofs = 300;
  rows.back().settings = "reduction.enrichment=[]";
  const std::string svg = bench_svg(results);
  EXPECT_THAT(svg, HasSubstr("Passive inflation"));
  EXPECT_THAT(svg, HasSubstr("264 unknowns, 1320 points, 0.250 s, 6.50 %"));
  EXPECT_THAT(svg, Not(HasSubstr("10101 unknowns")));
  EXPECT_THAT(svg, Not(HasSubstr("300 unknowns")));
  EXPECT_THAT(bench_svg({}), StartsWith("<svg"));
}

}  // namespace
}  // namespace cardiac
