#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>

#include <cardiac/anatomy/segments.hpp>
#include <cardiac/report/run_info.hpp>

namespace cardiac::test {

/// A beat of 800 ms with ED at 0 and ES at 330 ms in closed form: every segment s deforms by
/// amplitude_s · sin²(π min(t/2t_s, (1−t/T)/(2(1−t_s/T)))), largest at t_s. Segments in the anterior wall
/// stretch instead when `infarct` is set.
inline BeatResult synthetic_beat(bool infarct = false) {
  constexpr double kBeat = 800, kEs = 330;
  BeatResult r;
  r.method = "polyaffine";
  r.has_beat = r.completed = true;
  r.mesh_vertices = 1893, r.mesh_tets = 6542, r.dofs = 204, r.control_nodes = 17, r.integration_points = 2400;
  r.beats = 5, r.time_steps = 1834, r.newton_iterations = 5210, r.simulated_time_s = 4;
  r.cost = {.residuals = 5400,
            .factorisations = 610,
            .linear_solves = 5210,
            .filling_s = 0.11,
            .residual_s = 1.3,
            .tangent_s = 0.9,
            .factorisation_s = 0.4,
            .linear_solve_s = 0.2};
  r.wall_setup_s = 1.254, r.wall_solve_s = 3.127, r.wall_output_s = 0.412, r.wall_total_s = 4.793;
  r.min_det_F = 0.93, r.max_det_F = 1.06;
  r.strain = {-18.42, -21.3, 41.7, 12.6, {-21.1, -18.6, -15.2}, {-30.3, -21.9, -12.4}, 38.5, 14.1};
  r.nodes.resize(17);
  for (int i = 0; i < 17; ++i)
    r.segments.push_back({i + 1, aha_name(i + 1), 5 + 0.37 * (i % 7), 18.0 + 2.3 * (i % 9)});
  for (double t = 0; t <= kBeat; t += 10) {
    Instant& instant = r.instants.emplace_back();
    instant.time_ms = t;
    for (int s = 0; s < 17; ++s) {
      const bool scar = infarct && (s % 6 < 2) && s < 14;
      const double peak_time = kEs + 7 * (s % 5) - 14 + (scar ? 60 : 0);
      const double rise = t < peak_time ? t / peak_time : (kBeat - t) / (kBeat - peak_time);
      const double g = std::pow(std::sin(polyaffine::kPi / 2 * rise), 2) * (scar ? -0.25 : 1);
      SegmentStrain& e = instant.strain.emplace_back();
      e = {-(0.17 + 0.004 * (s % 8)) * g,
           -(0.19 + 0.005 * (s % 9)) * g,
           (0.30 + 0.02 * (s % 10)) * g,
           0.03 * g,
           -0.01 * g,
           0.02 * g,
           1 + 0.02 * g};
      SegmentFrame& frame = instant.frames.emplace_back();
      frame.A = Eigen::AngleAxisd(0.2 * g, polyaffine::Vec3::UnitZ()).toRotationMatrix() *
                polyaffine::Vec3(1 + e.longitudinal, 1 + e.circumferential, 1 + e.radial).asDiagonal();
      frame.t = {-9 * g, 0.5 * g, -3 * g};
      frame.misfit = 0.1 + 0.002 * s;
    }
    const double shortening = -instant.strain.front().circumferential;
    instant.global.push_back({-90 * shortening,
                              -100 * shortening,
                              200 * shortening,
                              60 * shortening,
                              {-110 * shortening, -95 * shortening, -80 * shortening},
                              {-150 * shortening, -105 * shortening, -60 * shortening},
                              190 * shortening,
                              70 * shortening});
  }
  VentricleSummary lv{"lv", 121.4, 50.2, 71.2, 58.65, 121.8, 8.3, 0, kEs, {}};
  for (double t = 0; t <= kBeat; t += 5) {
    const auto ramp = [t](double from, double to) { return (t - from) / (to - from); };
    const auto smooth = [](double s) { return 0.5 * (1 - std::cos(polyaffine::kPi * s)); };
    CavitySample s{t, 121.4, 8.3, Phase::isovolumetric_contraction};
    if (t < 50)
      s.pressure_mmHg = 8.3 + 71.7 * smooth(ramp(0, 50));
    else if (t < kEs)
      s = {t, 121.4 - 71.2 * smooth(ramp(50, kEs)),
           80 + 20 * ramp(50, kEs) + 32 * std::sin(polyaffine::kPi * ramp(50, kEs)), Phase::ejection};
    else if (t < 410)
      s = {t, 50.2, 100 - 96 * smooth(ramp(kEs, 410)), Phase::isovolumetric_relaxation};
    else
      s = {t, 50.2 + 71.2 * smooth(ramp(410, kBeat)), 4 + 4.3 * std::pow(ramp(410, kBeat), 2),
           Phase::filling};
    lv.samples.push_back(s);
  }
  r.ventricles.push_back(lv);
  r.plan = {{"fibres", true, "the tissue law is anisotropic"},
            {"activation", true, "contraction needs activation times"},
            {"right ventricle", false, "the mesh has one cavity"}};
  return r;
}

/// The same beat with a right ventricle: segments 18–29 and a cavity "rv", later and weaker.
inline BeatResult synthetic_biventricle() {
  BeatResult r = synthetic_beat();
  for (int s = 18; s <= 29; ++s)
    r.segments.push_back({s, "RV " + std::to_string(s), 2 + 0.1 * (s % 5), 22.0 + 1.7 * (s % 7)});
  for (Instant& instant : r.instants) {
    for (int s = 17; s < 29; ++s) {
      SegmentStrain e = instant.strain[s % 17];
      for (double* value : {&e.longitudinal, &e.circumferential, &e.radial}) *value *= 0.8 + 0.02 * (s - 17);
      instant.strain.push_back(e);
      instant.frames.push_back(instant.frames[s % 17]);
    }
  }
  VentricleSummary rv = r.ventricles[0];
  rv.name = "rv";
  rv.edv_mL = 131, rv.esv_mL = 59.8, rv.ef_percent = 54.4, rv.peak_pressure_mmHg = 29.4, rv.edp_mmHg = 4.1;
  rv.es_time_ms = 345;
  for (CavitySample& s : rv.samples) s.volume_mL += 9.6, s.pressure_mmHg *= 0.24;
  r.ventricles.push_back(rv);
  return r;
}

inline RunInfo synthetic_info() {
  return {"0.1.0",
          R"({"mesh": {"file": "meshes/healthy_lv.vtu", "length_unit": "mm"}, "time": {"rate_bpm": 75}})", 7};
}

/// A fresh folder that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("cardiac_" + std::to_string(std::random_device{}()))) {
    std::filesystem::create_directories(path_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace cardiac::test
