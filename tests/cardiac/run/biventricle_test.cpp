#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/model/vertex_displacement.hpp>
#include <cardiac/run/build_ventricle.hpp>
#include <cardiac/run/errors.hpp>
#include <cardiac/scene/loops.hpp>

#include <polyaffine/solve/load_stepping.hpp>

#include "support/affine_rebuild.hpp"
#include "support/heart_run.hpp"
#include "support/random_vector.hpp"
#include "support/tested_heart.hpp"

namespace cardiac {
namespace {

using polyaffine::Vector;
using polyaffine::testing::random_vector;

/// The shipped biventricle protocol on the coarse mesh, its anatomy computed once.
struct CoarseBiventricle {
  Protocol protocol = testing::shipped_protocol(
      "healthy_biv", {"mesh.file=\"" PROJECT_DIR "/meshes/healthy_biv_coarse.vtu\""});
  std::shared_ptr<const Anatomy> anatomy = testing::read_anatomy(protocol);

  static const CoarseBiventricle& get() {
    static const CoarseBiventricle out;
    return out;
  }
};

TEST(BiventricleHeart, PressuresFillBothCavitiesAndStrainAllSegments) {
  Protocol p = CoarseBiventricle::get().protocol;
  p.circulation.reset();
  p.contraction.reset();
  p.cavities = {10 * kPa_per_mmHg, 5 * kPa_per_mmHg};
  p.time.load_steps = 2;
  const testing::HeartRun run(p, CoarseBiventricle::get().anatomy);
  ASSERT_TRUE(run.path.completed) << run.path.stop_reason;
  const HeartState &rest = run.path.steps.front(), &filled = run.path.steps.back();
  EXPECT_GT(filled.volumes_mm3[0], 1.2 * rest.volumes_mm3[0]);
  EXPECT_GT(filled.volumes_mm3[1], 1.2 * rest.volumes_mm3[1]);
  EXPECT_NEAR(filled.pressures_kPa[1], 5 * kPa_per_mmHg, 1e-12);
  EXPECT_EQ(run.result.control_nodes, kBothSegments);
  ASSERT_EQ(run.result.ventricles.size(), 2U);
  EXPECT_EQ(run.result.ventricles[1].name, "rv");
  const auto& strain = run.result.instants.back().strain;
  ASSERT_EQ(strain.size(), kBothSegments);
  ASSERT_EQ(run.result.instants.back().frames.size(), kBothSegments);
  for (int s = 1; s <= kBothSegments; ++s) {
    const SegmentStrain& e = strain[s - 1];
    EXPECT_NEAR(e.volume_ratio, 1, 0.1) << aha_name(s);
    EXPECT_TRUE(std::isfinite(e.radial)) << aha_name(s);
    if (s <= 12) {
      EXPECT_GT(e.circumferential, 0) << aha_name(s);
    }
  }
  // Filling lengthens the contours of both; of the right one there is the free wall.
  const auto& global = run.result.instants.back().global;
  ASSERT_EQ(global.size(), 2U);
  for (const GlobalStrain& g : global) {
    EXPECT_GT(g.longitudinal.endocardial_percent, 1);
    EXPECT_GT(g.longitudinal.endocardial_percent, g.longitudinal.epicardial_percent);
    EXPECT_LT(g.wall_thickening_percent, -5);
  }
  EXPECT_TRUE(std::isnan(global[1].twist_deg));
  EXPECT_TRUE(std::isnan(global[1].circumferential.midwall_percent));
  ASSERT_TRUE(run.result.right_strain);
  EXPECT_EQ(run.result.right_strain->longitudinal.endocardial_percent,
            global[1].longitudinal.endocardial_percent);
  const auto vertices = vertex_displacement(run.ventricle);
  const Anatomy& anatomy = *run.ventricle.anatomy;
  for (const testing::RebuildErrors& errors :
       testing::rebuild_errors(anatomy.mesh, anatomy.segment, anatomy.mesh.points(),
                               anatomy.mesh.points() + vertices.apply(filled.c), run.result.nodes,
                               run.result.instants.back().frames))
    EXPECT_LT(errors.maps, 1.001 * errors.best);
  // More pressure on the right alone pushes the septum to the left.
  p.cavities = {10 * kPa_per_mmHg, 9 * kPa_per_mmHg};
  const testing::HeartRun more(p, CoarseBiventricle::get().anatomy);
  ASSERT_TRUE(more.path.completed) << more.path.stop_reason;
  EXPECT_GT(more.path.steps.back().volumes_mm3[1], filled.volumes_mm3[1]);
  EXPECT_LT(more.path.steps.back().volumes_mm3[0], filled.volumes_mm3[0]);
}

// The reduced model against quadratic elements on the same tets, filled. Two ventricles are its weak place
// (12 %, right cavity −6 %); the bounds stand at about 1.3 times what is reached, so that they notice a loss.
TEST(BiventricleHeart, ReducedModelFollowsTheFullOrder) {
  Protocol p = CoarseBiventricle::get().protocol;
  p.circulation.reset();
  p.cavities = {10 * kPa_per_mmHg, 5 * kPa_per_mmHg};
  const auto& anatomy = CoarseBiventricle::get().anatomy;
  const Ventricle reduced = build_ventricle(anatomy, p, protocol::Method::polyaffine);
  const Ventricle full = build_ventricle(anatomy, p, protocol::Method::fem);
  const auto equilibrium = [](const Ventricle& v) {
    Vector c = Vector::Zero(v.num_coefficients());
    const auto system = loaded_ventricle(
        v, {kPa_per_mmHg * Vector{{10, 5}}, Vector::Zero(v.discretisation.points.weights.size())});
    EXPECT_TRUE(polyaffine::load_stepping(system, *system.make_linear(), c).converged());
    return c;
  };
  const Vector c = equilibrium(reduced), truth = equilibrium(full);
  const ModelErrors errors = Yardstick(full, truth).errors(reduced, c);
  EXPECT_LT(errors.displacement_percent, 15);
  EXPECT_GT(errors.displacement_percent, 0.1);
  EXPECT_LT(std::abs(errors.volume_percent), 3);
  EXPECT_LT(errors.max_segment_strain, 0.08);
  EXPECT_NEAR(reduced.cavity_volume(c, 1) / full.cavity_volume(truth, 1), 1, 0.08);
}

TEST(BiventricleHeart, SolveInvertsTheDerivativeOfTheResidual) {
  Protocol p = CoarseBiventricle::get().protocol;
  p.tissue.viscosity_kPa_ms = 0;
  const Ventricle ventricle = build_ventricle(CoarseBiventricle::get().anatomy, p, p.reduction.method);
  testing::TestedHeart system(ventricle,
                              std::make_shared<TwoSidedCirculation>(two_sided_loop(*p.circulation)));
  const int n = ventricle.num_coefficients();
  ASSERT_EQ(system.size(), n + 8);
  const Vector c = random_vector(n, 0.02, 3);
  const HeartState state{250, c, ventricle.cavity_volumes(c), kPa_per_mmHg * Vector{{90, 20}},
                         kPa_per_mmHg * Vector{{80, 15, 9, 4}}};
  const Vector y = system.heart.pack(state);
  EXPECT_EQ((system.heart.pack(system.heart.unpack(0, y)) - y).norm(), 0);
  Vector rate = random_vector(system.size(), 1, 4);
  rate.head(n) *= 0.01;
  Vector d = random_vector(system.size(), 1, 5);
  d.segment(n, 2) *= 100;  // mm³
  const double alpha = 1, h = 1e-5;
  Vector plus, minus, x;
  ASSERT_TRUE(system.residual(250, y + h * d, rate + alpha * h * d, plus));
  ASSERT_TRUE(system.residual(250, y - h * d, rate - alpha * h * d, minus));
  ASSERT_TRUE(system.residual(250, y, rate, x));
  ASSERT_TRUE(system.factorise(250, y, rate, alpha));
  const double small = 1e-5;  // so that the circulation, which is solved as it is, is linear to 1e-5
  ASSERT_TRUE(system.solve(250, y, rate, small * (plus - minus) / (2 * h), x));
  x /= small;
  EXPECT_LT((x - d).head(n).norm(), 1e-4 * d.head(n).norm());
  EXPECT_LT((x - d).tail(8).cwiseQuotient(d.tail(8)).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(BiventricleHeart, ExtrapolationBetweenBeatsKeepsTheBlood) {
  Protocol p = CoarseBiventricle::get().protocol;
  p.time.limit_cycle_tolerance_percent = 1e-6;
  p.time.max_beats = 4;
  const testing::HeartRun run(p, CoarseBiventricle::get().anatomy);
  ASSERT_TRUE(run.path.completed) << run.path.stop_reason;
  ASSERT_EQ(run.path.cycle.size(), 4U);
  const TwoSidedCirculation circulation(two_sided_loop(*p.circulation));
  double moved = 0, before = 0, after = 0;
  for (std::size_t k = 0; k + 1 < run.path.cycle.size(); ++k) {
    const Vector &end = run.path.cycle[k].end, &start = run.path.cycle[k + 1].start;
    EXPECT_NEAR(circulation.blood_volume(start), circulation.blood_volume(end),
                1e-13 * circulation.blood_volume(end));
    EXPECT_EQ(start.head(2), end.head(2));  // the cavities keep theirs
    moved = std::max(moved, (start - end).tail(4).norm());
  }
  EXPECT_GT(moved, 0.01 * kPa_per_mmHg);
  const auto left = [](const CycleBeat& beat) { return (beat.end - beat.start).tail(4).norm(); };
  before = left(run.path.cycle[1]);
  after = left(run.path.cycle[3]);
  EXPECT_LT(after, 0.55 * before);  // .504 measured
  // Both sides pump the same on the limit cycle.
  const auto& v = run.result.ventricles;
  EXPECT_NEAR(v[0].haemodynamics->cardiac_output_L_per_min, v[1].haemodynamics->cardiac_output_L_per_min,
              0.03 * v[0].haemodynamics->cardiac_output_L_per_min);
  EXPECT_EQ(v[1].haemodynamics->valves[0].name, "tricuspid_valve");
  const auto& columns = run.result.circulation.columns;
  EXPECT_NE(std::find(columns.begin(), columns.end(), "pulmonary_artery_mmHg"), columns.end());
}

}  // namespace
}  // namespace cardiac
