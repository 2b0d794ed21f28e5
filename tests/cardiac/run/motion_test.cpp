#include "cardiac/run/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/model/vertex_displacement.hpp>
#include <cardiac/report/tables.hpp>

#include "support/affine_rebuild.hpp"
#include "support/heart_run.hpp"

namespace cardiac {
namespace {

using polyaffine::Points;
using polyaffine::Vector;

Points positions(const testing::HeartRun& run, const Vector& c) {
  return run.ventricle.anatomy->mesh.points() + vertex_displacement(run.ventricle).apply(c);
}

/// The maps of all segments at one output time rebuild the motion of the mesh since end diastole as well as
/// any affine map.
void expect_affine(const testing::HeartRun& run, std::size_t output) {
  const Anatomy& anatomy = *run.ventricle.anatomy;
  const Instant& instant = run.result.instants.at(output);
  const Points y = positions(run, run.key.ed.c);
  const Points x = positions(run, run.path.outputs.at(output).c);
  const auto errors =
      testing::rebuild_errors(anatomy.mesh, anatomy.segment, y, x, run.result.nodes, instant.frames);
  ASSERT_EQ(errors.size(), instant.strain.size());
  for (std::size_t s = 0; s < errors.size(); ++s) {
    SCOPED_TRACE(aha_name(static_cast<int>(s) + 1));
    EXPECT_LT(errors[s].maps, 1.001 * errors[s].best);
    EXPECT_NEAR(instant.frames[s].misfit, errors[s].best, 1e-9);
    EXPECT_LT(instant.frames[s].misfit, 0.5);
  }
}

std::size_t end_systolic_output(const testing::HeartRun& run) {
  const double es = run.key.es.time_ms;
  std::size_t best = 0;
  for (std::size_t k = 0; k < run.path.outputs.size(); ++k)
    if (std::abs(run.path.outputs[k].time_ms - es) < std::abs(run.path.outputs[best].time_ms - es)) best = k;
  return best;
}

TEST(AffineTable, OfAnInflationIsTheMotionOfTheSegments) {
  for (const std::vector<std::string>& settings : {std::vector<std::string>{},
                                                   {"reduction.preset=accurate"},
                                                   {"reduction.axes=cartesian"},
                                                   {"reduction.method=fem", "reduction.element_order=1"}}) {
    SCOPED_TRACE(settings.empty() ? "fast" : settings[0]);
    auto all = testing::on_land_ellipsoid(settings);
    all.emplace_back("time.load_steps=2");
    const testing::HeartRun run(testing::shipped_protocol("passive_inflation", all));
    ASSERT_TRUE(run.path.completed) << run.path.stop_reason;
    expect_affine(run, run.path.outputs.size() - 1);
  }
}

TEST(AffineTable, OfABeatIsTheMotionSinceEndDiastole) {
  for (const char* name : {"healthy_lv", "infarct_lv"}) {
    SCOPED_TRACE(name);
    const auto& run = testing::shipped_run(name);
    expect_affine(run, end_systolic_output(run));
  }
}

std::vector<std::vector<std::string>> rows_of(const std::string& table) {
  std::istringstream text(table);
  std::string line, cell;
  std::vector<std::vector<std::string>> out;
  std::getline(text, line);
  EXPECT_EQ(line, "time_ms,frame,axes,function,c_1_mm,c_2_mm,c_3_mm");
  while (std::getline(text, line)) {
    auto& row = out.emplace_back();
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return out;
}

/// The displacement of a point by the rows of one time, from the weights, coordinates and axes of the frames.
polyaffine::Vec3 displacement(const std::vector<std::vector<std::string>>& rows, std::size_t first,
                              std::size_t count, const std::vector<std::string>& names,
                              const polyaffine::FramesAtPoint& at) {
  polyaffine::Vec3 u = polyaffine::Vec3::Zero();
  for (std::size_t k = first; k < first + count; ++k) {
    const auto& row = rows[k];
    for (const auto& f : at.frames) {
      if (names[f.frame] != row[1]) continue;
      double value = f.weight;
      for (const char letter : row[3])
        if (letter != '1') value *= f.xi[letter == 'l' ? 0 : letter == 'c' ? 1 : 2];
      const polyaffine::Vec3 c(std::strtod(row[4].c_str(), nullptr), std::strtod(row[5].c_str(), nullptr),
                               std::strtod(row[6].c_str(), nullptr));
      u += value * (row[2] == "local" ? polyaffine::Vec3(at.Q * c) : c);
    }
  }
  return u;
}

TEST(FramesTable, AppliedGivesTheDisplacement) {
  for (const std::vector<std::string>& settings : {std::vector<std::string>{"reduction.preset=fast"},
                                                   {"reduction.preset=accurate"},
                                                   {"reduction.axes=cartesian"},
                                                   {"reduction.ring_nodes=[3,4]"},
                                                   {"reduction.weights=sigmoid"}}) {
    SCOPED_TRACE(settings[0]);
    auto all = testing::on_land_ellipsoid(settings);
    all.insert(all.end(), {"time.load_steps=2", "output.frames=true"});
    const testing::HeartRun run(testing::shipped_protocol("passive_inflation", all));
    const auto rows = rows_of(frames_table(run.result));
    const auto& basis = *run.ventricle.discretisation.frame_basis;
    const auto functions = static_cast<std::size_t>(basis.num_functions());
    ASSERT_EQ(rows.size(), functions * run.path.outputs.size());
    // Names in the order of the frames.
    std::vector<std::string> names;
    for (std::size_t k = 0; k < functions; ++k)
      if (names.empty() || names.back() != rows[k][1]) names.push_back(rows[k][1]);
    ASSERT_EQ(names.size(), basis.frames().size());
    const Points u = vertex_displacement(run.ventricle).apply(run.path.outputs.back().c);
    const auto vertices = vertex_points(run.ventricle.anatomy->mesh);
    double error = 0;
    for (Eigen::Index v = 0; v < u.cols(); v += 7) {
      const auto at = basis.field().sample(vertices.tet[v], vertices.barycentric.col(v));
      error = std::max(error,
                       (displacement(rows, rows.size() - functions, functions, names, at) - u.col(v)).norm());
    }
    EXPECT_GT(u.cwiseAbs().maxCoeff(), 0.5);
    EXPECT_LT(error, 1e-9 * u.cwiseAbs().maxCoeff());
  }
}

TEST(FramesTable, IsThereWhenAskedForOnly) {
  const auto& run = testing::shipped_run("passive_inflation");
  EXPECT_TRUE(run.result.frame_functions.empty());
  EXPECT_TRUE(run.result.instants.back().frame_unknowns.empty());
}

// The same beat measured along contours and as means over the wall (clinics measure the former): shortening
// is largest inside, where the wall thickens into the cavity.
TEST(GlobalStrainOfABeat, IsLargestAtTheEndocardium) {
  const auto& run = testing::shipped_run("healthy_lv");
  const GlobalStrain& g = run.result.strain;
  EXPECT_LT(g.longitudinal.endocardial_percent, g.longitudinal.midwall_percent);
  EXPECT_LT(g.longitudinal.midwall_percent, g.longitudinal.epicardial_percent);
  EXPECT_LT(g.circumferential.endocardial_percent, g.circumferential.midwall_percent);
  EXPECT_LT(g.circumferential.midwall_percent, g.circumferential.epicardial_percent);
  EXPECT_LT(g.longitudinal.endocardial_percent, g.gls_percent - 3);
  // Thickness from volume and areas against the mean over the wall of the radial strain.
  EXPECT_NEAR(g.wall_thickening_percent, g.grs_percent, 3);
  EXPECT_FALSE(run.result.right_strain);
  const GlobalStrain& start = run.result.instants.front().global.at(0);
  EXPECT_NEAR(start.longitudinal.endocardial_percent, 0, 2);
}

}  // namespace
}  // namespace cardiac
