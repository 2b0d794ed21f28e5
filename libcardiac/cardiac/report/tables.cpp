#include <cardiac/report/tables.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include <cardiac/report/csv_writer.hpp>
#include <cardiac/report/filling.hpp>
#include <cardiac/report/global_columns.hpp>
#include <cardiac/report/summary.hpp>
#include <cardiac/report/text.hpp>
#include <cardiac/strain/peaks.hpp>
#include <polyaffine/core/atomic_file.hpp>

namespace cardiac {
namespace {

using polyaffine::Mat3;
using polyaffine::Vec3;

CsvWriter& operator<<(CsvWriter& csv, const SegmentInfo& segment) {
  return csv << segment.number << segment.name;
}

CsvWriter& operator<<(CsvWriter& csv, const Vec3& v) {
  return csv << v(0) << v(1) << v(2);
}

/// The instants with the digits that the tables show, so that what is derived from them is the same when it
/// is computed again from the files.
std::vector<Instant> as_written(std::vector<Instant> instants) {
  for (Instant& instant : instants) {
    instant.time_ms = rounded_for_files(instant.time_ms);
    for (SegmentStrain& s : instant.strain)
      for (double* value : {&s.longitudinal, &s.circumferential, &s.radial})
        *value = rounded_for_files(*value);
    for (SegmentFrame& frame : instant.frames) frame.A = frame.A.unaryExpr(&rounded_for_files);
  }
  return instants;
}

struct Polar {
  double rotation_deg;
  Vec3 stretch;
};

Polar polar(const Mat3& A) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (!A.allFinite()) return {kNone, Vec3::Constant(kNone)};
  // Dynamic size: g++ 12 warns of fixed-size singular values without cause.
  const Eigen::JacobiSVD<polyaffine::Matrix> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 W = svd.matrixU();
  Vec3 stretch = svd.singularValues();
  if (W.determinant() * svd.matrixV().determinant() < 0) {
    W.col(2) *= -1;
    stretch(2) *= -1;
  }
  const Mat3 R = W * svd.matrixV().transpose();
  const Vec3 axial(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return {std::atan2(axial.norm(), R.trace() - 1) * 180 / polyaffine::kPi, stretch};
}

}  // namespace

std::string strain_table(const BeatResult& result) {
  CsvWriter csv(
      "time_ms,segment,name,longitudinal,circumferential,radial,shear_lc,shear_lr,shear_cr,volume_ratio");
  for (const Instant& instant : result.instants)
    for (size_t i = 0; i < instant.strain.size(); ++i) {
      const SegmentStrain& s = instant.strain[i];
      csv << instant.time_ms << result.segments.at(i) << s.longitudinal << s.circumferential << s.radial
          << s.shear_lc << s.shear_lr << s.shear_cr << s.volume_ratio;
      csv.end_row();
    }
  return csv.text();
}

std::string peaks_table(const BeatResult& result) {
  std::string header = "segment,name";
  for (const std::string strain : {"longitudinal", "circumferential", "radial"}) {
    header += ",peak_" + strain + ",peak_" + strain + "_time_ms,systolic_peak_" + strain + ",end_systolic_" +
              strain + ",post_systolic_index_" + strain + "_percent";
  }
  CsvWriter csv(header);
  const auto [ed_ms, es_ms] = cardiac_times(result);
  const std::vector<SegmentPeaks> peaks =
      strain_peaks(as_written(result.instants), rounded_for_files(ed_ms), rounded_for_files(es_ms));
  for (size_t i = 0; i < peaks.size(); ++i) {
    csv << result.segments.at(i);
    for (const StrainPeak& p : {peaks[i].longitudinal, peaks[i].circumferential, peaks[i].radial})
      csv << p.value << p.time_ms << p.systolic << p.end_systolic << p.post_systolic_index_percent;
    csv.end_row();
  }
  return csv.text();
}

std::string affine_table(const BeatResult& result) {
  CsvWriter csv(
      "time_ms,segment,name,a_11,a_12,a_13,a_21,a_22,a_23,a_31,a_32,a_33,t_1_mm,t_2_mm,t_3_mm,"
      "rotation_deg,stretch_1,stretch_2,stretch_3,determinant,misfit");
  for (const Instant& instant : as_written(result.instants))
    for (size_t i = 0; i < instant.frames.size(); ++i) {
      const auto& [A, t, misfit] = instant.frames[i];
      const Polar p = polar(A);
      csv << instant.time_ms << result.segments.at(i);
      for (int row = 0; row < 3; ++row) csv << Vec3(A.row(row));
      csv << t << p.rotation_deg << p.stretch << A.determinant() << misfit;
      csv.end_row();
    }
  return csv.text();
}

std::string nodes_table(const BeatResult& result) {
  CsvWriter csv("segment,name,x_mm,y_mm,z_mm,l_x,l_y,l_z,c_x,c_y,c_z,r_x,r_y,r_z");
  for (size_t i = 0; i < result.nodes.size(); ++i) {
    const auto& [q, axes] = result.nodes[i];
    csv << result.segments.at(i) << q;
    for (int k = 0; k < 3; ++k) csv << Vec3(axes.col(k));
    csv.end_row();
  }
  return csv.text();
}

std::string global_strain_table(const BeatResult& result) {
  std::string header = "time_ms,ventricle";
  for (const auto& quantity : kGlobalStrain) header += "," + quantity.column;
  CsvWriter csv(header);
  for (const Instant& instant : result.instants)
    for (size_t i = 0; i < instant.global.size(); ++i) {
      csv << instant.time_ms << result.ventricles.at(i).name;
      for (const auto& quantity : kGlobalStrain) csv << quantity.value(instant.global[i]);
      csv.end_row();
    }
  return csv.text();
}

std::string frames_table(const BeatResult& result) {
  CsvWriter csv("time_ms,frame,axes,function,c_1_mm,c_2_mm,c_3_mm");
  for (const Instant& instant : result.instants)
    for (size_t k = 0; k < instant.frame_unknowns.size(); ++k) {
      const FrameFunction& f = result.frame_functions.at(k);
      csv << instant.time_ms << f.frame << (f.local_axes ? "local" : "cartesian") << f.function;
      for (const double c : instant.frame_unknowns[k]) csv << exact_text(c);
      csv.end_row();
    }
  return csv.text();
}

std::string mechanics_table(const BeatResult& result) {
  CsvWriter csv(
      "time_ms,segment,name,fibre_strain,fibre_stress_kPa,active_stress_kPa,mean_stress_kPa,von_mises_kPa,"
      "work_mJ,active_work_mJ");
  for (const Instant& instant : result.instants)
    for (size_t i = 0; i < instant.mechanics.size(); ++i) {
      const SegmentMechanics& m = instant.mechanics[i];
      csv << instant.time_ms << result.segments.at(i) << m.fibre_strain << m.fibre_stress_kPa
          << m.active_stress_kPa << m.mean_stress_kPa << m.von_mises_kPa << m.work_mJ << m.active_work_mJ;
      csv.end_row();
    }
  return csv.text();
}

std::string cavity_table(const BeatResult& result) {
  CsvWriter csv("time_ms,ventricle,volume_mL,pressure_mmHg,phase");
  for (const VentricleSummary& ventricle : result.ventricles)
    for (const CavitySample& s : ventricle.samples) {
      csv << s.time_ms << ventricle.name << s.volume_mL << s.pressure_mmHg
          << (result.has_beat ? phase_name(s.phase) : "");
      csv.end_row();
    }
  return csv.text();
}

std::string circulation_text(const BeatResult& result) {
  const CirculationTable& table = result.circulation;
  std::string header;
  for (const std::string& name : table.columns) header += (header.empty() ? "" : ",") + name;
  CsvWriter csv(header);
  const std::size_t rows = table.values.empty() ? 0 : table.values.front().size();
  for (std::size_t row = 0; row < rows; ++row) {
    for (const auto& column : table.values) csv << column.at(row);
    csv.end_row();
  }
  return csv.text();
}

std::string phase_name(Phase phase) {
  switch (phase) {
    case Phase::filling:
      return "filling";
    case Phase::isovolumetric_contraction:
      return "isovolumetric_contraction";
    case Phase::ejection:
      return "ejection";
    case Phase::isovolumetric_relaxation:
      return "isovolumetric_relaxation";
  }
  return "";
}

CardiacTimes cardiac_times(const BeatResult& result) {
  const auto lv = std::ranges::find(result.ventricles, "lv", &VentricleSummary::name);
  if (has_systole(result) && !result.ventricles.empty()) {
    const VentricleSummary& v = lv != result.ventricles.end() ? *lv : result.ventricles.front();
    if (std::isfinite(v.ed_time_ms) && std::isfinite(v.es_time_ms)) return {v.ed_time_ms, v.es_time_ms};
  }
  if (result.instants.empty()) return {};
  return {result.instants.front().time_ms, result.instants.back().time_ms};
}

bool has_systole(const BeatResult& result) {
  return result.has_beat || result.has_contraction;
}

void write_tables(const BeatResult& result, const RunInfo& info, const std::filesystem::path& out) {
  const std::string summary = summary_text(result, info);
  polyaffine::make_folder(out);
  polyaffine::write_atomically(out / "strain.csv", strain_table(result));
  polyaffine::write_atomically(out / "strain_peaks.csv", peaks_table(result));
  polyaffine::write_atomically(out / "affine.csv", affine_table(result));
  polyaffine::write_atomically(out / "control_nodes.csv", nodes_table(result));
  polyaffine::write_atomically(out / "global_strain.csv", global_strain_table(result));
  if (!result.frame_functions.empty()) polyaffine::write_atomically(out / "frames.csv", frames_table(result));
  if (!result.instants.empty() && !result.instants.front().mechanics.empty())
    polyaffine::write_atomically(out / "mechanics.csv", mechanics_table(result));
  polyaffine::write_atomically(out / "cavity.csv", cavity_table(result));
  if (result.unloading) polyaffine::write_atomically(out / "filling.csv", filling_table(*result.unloading));
  if (!result.circulation.columns.empty())
    polyaffine::write_atomically(out / "circulation.csv", circulation_text(result));
  polyaffine::write_atomically(out / "summary.json", summary);
}

}  // namespace cardiac
