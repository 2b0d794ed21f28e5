#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/anatomy/structured_ellipsoid.hpp>
#include <cardiac/model/vertex_displacement.hpp>
#include <cardiac/strain/peaks.hpp>

#include "support/heart_run.hpp"

// Shipped protocols of diseased hearts show the signs by which the disease is known, beside the healthy
// heart. Bounds are those of guidelines, or a direction with a margin that no tolerance of the model reaches.
namespace cardiac {
namespace {

const BeatResult& of(const char* name) {
  const testing::HeartRun& run = testing::shipped_run(name);
  EXPECT_TRUE(run.path.completed) << name << ": " << run.path.stop_reason;
  EXPECT_TRUE(run.result.warnings.empty()) << name << ": " << run.result.warnings.front();
  return run.result;
}

const VentricleSummary& left(const char* name) {
  return of(name).ventricles.at(0);
}

double pulse(const Haemodynamics& h) {
  return h.arterial_systolic_mmHg - h.arterial_diastolic_mmHg;
}

constexpr int kInlet = 0, kOutlet = 1;  // of Haemodynamics::valves

// Severe: half of what the ventricle ejects goes back (Zoghbi et al. 2017). The atrium unloads the ventricle,
// so that it empties well while less reaches the aorta, and blood moves in both phases that are else
// isovolumetric (Carabello 2008).
TEST(Disease, MitralRegurgitationEjectsIntoTheAtrium) {
  const auto &healthy = left("healthy_lv"), &lv = left("mitral_regurgitation");
  const auto& leak = lv.haemodynamics->valves.at(kInlet);
  EXPECT_GT(leak.regurgitant_percent, 40);
  EXPECT_NEAR(leak.forward_mL - leak.regurgitant_mL, lv.haemodynamics->valves.at(kOutlet).forward_mL, 1);
  EXPECT_LT(lv.haemodynamics->cardiac_output_L_per_min,
            healthy.haemodynamics->cardiac_output_L_per_min - 0.5);
  EXPECT_GT(lv.sv_mL, healthy.sv_mL + 15);
  EXPECT_GT(lv.ef_percent, healthy.ef_percent + 5);
  EXPECT_LT(lv.ef_percent, 80);
  EXPECT_LT(lv.isovolumetric_contraction_change_mL, -1);
  EXPECT_LT(lv.isovolumetric_relaxation_change_mL, -5);
  EXPECT_GT(healthy.isovolumetric_contraction_change_mL, -0.1);
  EXPECT_GT(healthy.isovolumetric_relaxation_change_mL, -0.1);
  EXPECT_LT(lv.es_time_ms, healthy.es_time_ms - 50) << "the aortic valve closes early";
}

// The aorta empties into the ventricle in diastole: low diastolic and wide pulse pressure, a large stroke
// from a large end-diastolic volume, at an end-diastolic pressure above the atrium's (Bekeredjian and
// Grayburn 2005).
TEST(Disease, AorticRegurgitationWidensThePulse) {
  const auto &healthy = left("healthy_lv"), &lv = left("aortic_regurgitation");
  const auto& h = *lv.haemodynamics;
  EXPECT_GT(h.valves.at(kOutlet).regurgitant_percent, 40);
  EXPECT_GT(h.valves.at(kOutlet).regurgitant_mL, 45);
  EXPECT_LT(h.arterial_diastolic_mmHg, 50);
  EXPECT_GT(h.arterial_diastolic_mmHg, 20);
  EXPECT_GT(pulse(h), pulse(*healthy.haemodynamics) + 25);
  EXPECT_GT(lv.edv_mL, healthy.edv_mL + 30);
  EXPECT_GT(lv.sv_mL, 1.5 * healthy.sv_mL);
  EXPECT_LT(h.cardiac_output_L_per_min, healthy.haemodynamics->cardiac_output_L_per_min);
  EXPECT_GT(lv.edp_mmHg, h.venous_mean_mmHg + 3) << "the mitral valve closes before systole";
  EXPECT_GT(lv.isovolumetric_relaxation_change_mL, 5);
}

// Severe: mean gradient above 40 mmHg at a normal output (Baumgartner et al. 2017).
TEST(Disease, AorticStenosisLoadsTheVentricleAlone) {
  const auto &healthy = left("healthy_lv"), &lv = left("aortic_stenosis");
  const auto &h = *lv.haemodynamics, &normal = *healthy.haemodynamics;
  EXPECT_GT(h.valves.at(kOutlet).mean_gradient_mmHg, 40);
  EXPECT_GT(h.valves.at(kOutlet).peak_gradient_mmHg, 64) << "4 m/s";
  EXPECT_LT(normal.valves.at(kOutlet).mean_gradient_mmHg, 5);
  EXPECT_GT(lv.peak_pressure_mmHg, h.arterial_systolic_mmHg + 40);
  EXPECT_LT(healthy.peak_pressure_mmHg, normal.arterial_systolic_mmHg + 10);
  EXPECT_NEAR(h.arterial_systolic_mmHg, normal.arterial_systolic_mmHg, 15);
  EXPECT_GT(h.cardiac_output_L_per_min, 4);
  EXPECT_GT(h.stroke_work_mJ, 1.3 * normal.stroke_work_mJ);
  EXPECT_GT(lv.ef_percent, 50);
}

// Hypertension: mean pulmonary pressure above 20 mmHg (25 until 2018) and more than 2 Wood units (Humbert et
// al. 2022); the right ventricle cannot empty against it. On the coarse mesh, three beats.
TEST(Disease, PulmonaryHypertensionLoadsTheRightVentricle) {
  const std::vector<std::string> coarse{"mesh.file=\"" PROJECT_DIR "/meshes/healthy_biv_coarse.vtu\"",
                                        "time.max_beats=3", "output.mesh_series=false"};
  const testing::HeartRun sick(testing::shipped_protocol("pulmonary_hypertension", coarse));
  const testing::HeartRun well(testing::shipped_protocol("healthy_biv", coarse));
  ASSERT_TRUE(sick.path.completed) << sick.path.stop_reason;
  ASSERT_TRUE(well.path.completed) << well.path.stop_reason;
  const auto &rv = sick.result.ventricles.at(1), &healthy = well.result.ventricles.at(1);
  const auto& h = *rv.haemodynamics;
  EXPECT_GT(rv.peak_pressure_mmHg, 50);
  EXPECT_LT(healthy.peak_pressure_mmHg, 35);
  EXPECT_GT(h.arterial_mean_mmHg, 35);
  EXPECT_LT(healthy.haemodynamics->arterial_mean_mmHg, 20);
  const auto& lungs =
      *sick.result.ventricles.at(0).haemodynamics;  // before the mitral valve: the wedge pressure
  EXPECT_LT(lungs.venous_mean_mmHg, 15) << "precapillary";
  // Mean pressures over the mean flow give the file's resistance back, that of the arteries' beginning with
  // it: 0.48 + 0.01 mmHg·s/mL are 8.17 Wood units; 0.015 of it is how far three beats are from repeating
  // themselves.
  EXPECT_NEAR((h.arterial_mean_mmHg - lungs.venous_mean_mmHg) / h.cardiac_output_L_per_min, 0.49 / 0.06,
              0.03);
  EXPECT_LT(rv.ef_percent, healthy.ef_percent - 5);
  EXPECT_GT(rv.esv_mL, healthy.esv_mL + 12);
  EXPECT_GT(rv.edp_mmHg, healthy.edp_mmHg + 1);
}

/// Peak circumferential shortening of a segment and its greatest stretch in systole, against end diastole.
struct Shortening {
  double peak_ms = 0, stretch = 0, early = 0;
};

Shortening shortening(const BeatResult& r, int segment) {
  const auto& lv = r.ventricles.at(0);
  Shortening out{
      .peak_ms = strain_peaks(r.instants, lv.ed_time_ms, lv.es_time_ms)[segment - 1].circumferential.time_ms};
  for (const Instant& i : r.instants) {
    if (i.time_ms < lv.ed_time_ms || i.time_ms > lv.es_time_ms) continue;
    const double strain = i.strain[segment - 1].circumferential;
    out.stretch = std::max(out.stretch, strain);
    if (i.time_ms < lv.ed_time_ms + 80) out.early = std::min(out.early, strain);
  }
  return out;
}

// The septum shortens before ejection and stretches the lateral wall, which shortens last and most (Prinzen
// et al. 1999); septum and lateral wall peak more than 65 ms apart (dyssynchrony, Bax et al. 2004); pressure
// rises more slowly and the stroke is smaller (Vernooy et al. 2005).
TEST(Disease, LeftBundleBranchBlockDelaysTheLateralWall) {
  const BeatResult &r = of("left_bundle_branch_block"), &normal = of("healthy_lv");
  const auto &lv = r.ventricles.at(0), &healthy = normal.ventricles.at(0);
  constexpr std::array kSeptal{8, 9, 14};
  constexpr std::array kLateral{5, 6, 11, 12, 16};
  double first = 1e9, last = 0, first_normal = 1e9, last_normal = 0;
  for (int s = 7; s <= 12; ++s) {  // all at the same height, which peak together in the healthy heart
    first = std::min(first, shortening(r, s).peak_ms);
    last = std::max(last, shortening(r, s).peak_ms);
    first_normal = std::min(first_normal, shortening(normal, s).peak_ms);
    last_normal = std::max(last_normal, shortening(normal, s).peak_ms);
  }
  EXPECT_GT(last - first, 65);
  EXPECT_LE(last_normal - first_normal, 20);
  for (const int s : kSeptal) {
    EXPECT_LT(shortening(r, s).early, -0.08) << aha_name(s);
    EXPECT_LT(shortening(r, s).stretch, 0.02) << aha_name(s);
    for (const int l : kLateral)
      EXPECT_LT(shortening(r, s).peak_ms + 40, shortening(r, l).peak_ms)
          << aha_name(s) << ", " << aha_name(l);
  }
  for (const int s : kLateral) {
    EXPECT_GT(shortening(r, s).early, -0.01) << aha_name(s);
    EXPECT_GT(shortening(r, s).stretch, 0.05) << aha_name(s);
    EXPECT_LT(shortening(normal, s).stretch, 0.03) << aha_name(s);
  }
  EXPECT_LT(lv.haemodynamics->dp_dt_max_mmHg_per_s, 0.85 * healthy.haemodynamics->dp_dt_max_mmHg_per_s);
  EXPECT_LT(lv.sv_mL, healthy.sv_mL - 1);
  EXPECT_LT(lv.haemodynamics->stroke_work_mJ, 0.97 * healthy.haemodynamics->stroke_work_mJ);
}

/// A protocol on the structured mesh of its ellipsoid.
struct EllipsoidHeart {
  testing::HeartRun run;
  double thickness_mm = 0;  ///< at the equator, at end diastole

  explicit EllipsoidHeart(const char* name, const std::vector<std::string>& overrides = {})
      : EllipsoidHeart(testing::shipped_protocol(name, overrides)) {}
  explicit EllipsoidHeart(const Protocol& protocol) : run(protocol, anatomy(protocol)) {
    EXPECT_TRUE(run.path.completed) << run.path.stop_reason;
    const TruncatedEllipsoid shape = scaled_shape(protocol);
    const polyaffine::Points moved = vertex_displacement(run.ventricle).apply(run.key.ed.c);
    const auto at = [&](double x) {
      const auto& points = run.ventricle.anatomy->mesh.points();
      Eigen::Index nearest = 0;
      (points.colwise() - Vec3(x, 0, 0)).colwise().squaredNorm().minCoeff(&nearest);
      return Vec3(points.col(nearest) + moved.col(nearest));
    };
    thickness_mm = (at(shape.epi_short_mm) - at(shape.endo_short_mm)).norm();
  }

  static TruncatedEllipsoid scaled_shape(const Protocol& protocol) {
    return protocol.mesh.shape ? ellipsoid_of(protocol.mesh) : human_lv();
  }
  static std::shared_ptr<const Anatomy> anatomy(const Protocol& protocol) {
    const CurvedMesh made = structured_ellipsoid(scaled_shape(protocol), {10, 18, 2});
    return std::make_shared<const Anatomy>(
        build_anatomy(made.mesh, protocol, {.midpoints = made.midpoints, .fibres = {}}));
  }
  const VentricleSummary& lv() const { return run.result.ventricles.at(0); }

  static const EllipsoidHeart& healthy() {
    static const EllipsoidHeart out("healthy_lv");
    return out;
  }
};

// Dilated: a left ventricle that is enlarged and ejects less than 40 to 45 % (Pinto et al. 2016), shortens
// less in all directions, twists less and needs a higher filling pressure for its output.
TEST(Disease, ADilatedHeartEjectsASmallPartOfALargeVolume) {
  const EllipsoidHeart sick("dilated");
  const auto &lv = sick.lv(), &healthy = EllipsoidHeart::healthy().lv();
  EXPECT_LT(lv.ef_percent, 40);
  EXPECT_GT(lv.ef_percent, 15);
  EXPECT_GT(lv.edv_mL, 180);
  EXPECT_GT(lv.edv_mL, 1.5 * healthy.edv_mL);
  EXPECT_GT(lv.edp_mmHg, healthy.edp_mmHg + 5);
  const auto &strain = sick.run.result.strain, &normal = EllipsoidHeart::healthy().run.result.strain;
  EXPECT_LT(std::abs(strain.gls_percent), std::abs(normal.gls_percent) - 3);
  EXPECT_LT(std::abs(strain.gcs_percent), std::abs(normal.gcs_percent) - 5);
  EXPECT_LT(strain.twist_deg, 0.7 * normal.twist_deg);
  EXPECT_LT(lv.haemodynamics->dp_dt_max_mmHg_per_s, 1000);
}

// Hypertrophic: walls from 15 mm (Elliott et al. 2014) around a small cavity, a normal or high ejection
// fraction and yet less longitudinal shortening (Smiseth et al. 2016), a diastolic pressure that is high for
// the volume.
TEST(Disease, AHypertrophicHeartEjectsWellAndFillsBadly) {
  const EllipsoidHeart sick("hypertrophic");
  const EllipsoidHeart& well = EllipsoidHeart::healthy();
  const auto &lv = sick.lv(), &healthy = well.lv();
  EXPECT_GT(lv.ef_percent, healthy.ef_percent);
  EXPECT_LT(lv.ef_percent, 80);
  EXPECT_LT(lv.edv_mL, healthy.edv_mL - 15);
  EXPECT_GT(lv.edp_mmHg, healthy.edp_mmHg + 5) << "at less volume";
  EXPECT_GT(sick.thickness_mm, 1.4 * well.thickness_mm);
  EXPECT_GT(sick.thickness_mm, 12) << "15 mm without load, thinner once filled";
  EXPECT_LT(well.thickness_mm, 10) << "10 mm without load";
  EXPECT_LT(std::abs(sick.run.result.strain.gls_percent), std::abs(well.run.result.strain.gls_percent) - 2);
}

}  // namespace
}  // namespace cardiac
