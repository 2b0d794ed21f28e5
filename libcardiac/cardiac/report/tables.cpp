#include <cardiac/report/tables.hpp>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include <cardiac/report/global_columns.hpp>
#include <cardiac/report/summary.hpp>
#include <cardiac/report/text.hpp>
#include <cardiac/strain/peaks.hpp>
#include <polyaffine/core/atomic_file.hpp>

namespace cardiac {
namespace {

using polyaffine::Mat3;
using polyaffine::Vec3;

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string out = "\"";
  for (const char c : field) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string segment_fields(const SegmentInfo& segment) {
  return std::to_string(segment.number) + "," + quoted(segment.name);
}

void append(std::string& row, std::initializer_list<double> values) {
  for (const double value : values) (row += ',') += number_text(value);
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
  std::string text =
      "time_ms,segment,name,longitudinal,circumferential,radial,shear_lc,shear_lr,shear_cr,volume_ratio\n";
  for (const Instant& instant : result.instants) {
    for (size_t i = 0; i < instant.strain.size(); ++i) {
      const SegmentStrain& s = instant.strain[i];
      text += number_text(instant.time_ms) + "," + segment_fields(result.segments.at(i));
      append(text, {s.longitudinal, s.circumferential, s.radial, s.shear_lc, s.shear_lr, s.shear_cr,
                    s.volume_ratio});
      text += '\n';
    }
  }
  return text;
}

std::string peaks_table(const BeatResult& result) {
  std::string text = "segment,name";
  for (const std::string strain : {"longitudinal", "circumferential", "radial"}) {
    text += ",peak_" + strain + ",peak_" + strain + "_time_ms,systolic_peak_" + strain + ",end_systolic_" +
            strain + ",post_systolic_index_" + strain + "_percent";
  }
  text += '\n';
  const auto [ed_ms, es_ms] = cardiac_times(result);
  const std::vector<SegmentPeaks> peaks =
      strain_peaks(as_written(result.instants), rounded_for_files(ed_ms), rounded_for_files(es_ms));
  for (size_t i = 0; i < peaks.size(); ++i) {
    text += segment_fields(result.segments.at(i));
    for (const StrainPeak& p : {peaks[i].longitudinal, peaks[i].circumferential, peaks[i].radial})
      append(text, {p.value, p.time_ms, p.systolic, p.end_systolic, p.post_systolic_index_percent});
    text += '\n';
  }
  return text;
}

std::string affine_table(const BeatResult& result) {
  std::string text =
      "time_ms,segment,name,a_11,a_12,a_13,a_21,a_22,a_23,a_31,a_32,a_33,t_1_mm,t_2_mm,t_3_mm,"
      "rotation_deg,stretch_1,stretch_2,stretch_3,determinant,misfit\n";
  for (const Instant& instant : as_written(result.instants)) {
    for (size_t i = 0; i < instant.frames.size(); ++i) {
      const auto& [A, t, misfit] = instant.frames[i];
      const Polar p = polar(A);
      text += number_text(instant.time_ms) + "," + segment_fields(result.segments.at(i));
      for (int row = 0; row < 3; ++row) append(text, {A(row, 0), A(row, 1), A(row, 2)});
      append(text, {t(0), t(1), t(2), p.rotation_deg, p.stretch(0), p.stretch(1), p.stretch(2),
                    A.determinant(), misfit});
      text += '\n';
    }
  }
  return text;
}

std::string nodes_table(const BeatResult& result) {
  std::string text = "segment,name,x_mm,y_mm,z_mm";
  for (const char axis : {'l', 'c', 'r'})
    for (const char component : {'x', 'y', 'z'}) text += std::string(",") + axis + "_" + component;
  text += '\n';
  for (size_t i = 0; i < result.nodes.size(); ++i) {
    const auto& [q, axes] = result.nodes[i];
    text += segment_fields(result.segments.at(i));
    append(text, {q(0), q(1), q(2)});
    for (int k = 0; k < 3; ++k) append(text, {axes(0, k), axes(1, k), axes(2, k)});
    text += '\n';
  }
  return text;
}

std::string global_strain_table(const BeatResult& result) {
  std::string text = "time_ms,ventricle";
  for (const auto& quantity : kGlobalStrain) text += "," + quantity.column;
  text += '\n';
  for (const Instant& instant : result.instants) {
    for (size_t i = 0; i < instant.global.size(); ++i) {
      text += number_text(instant.time_ms) + "," + quoted(result.ventricles.at(i).name);
      for (const auto& quantity : kGlobalStrain) append(text, {quantity.value(instant.global[i])});
      text += '\n';
    }
  }
  return text;
}

std::string frames_table(const BeatResult& result) {
  std::string text = "time_ms,frame,axes,function,c_1_mm,c_2_mm,c_3_mm\n";
  for (const Instant& instant : result.instants) {
    for (size_t k = 0; k < instant.frame_unknowns.size(); ++k) {
      const FrameFunction& f = result.frame_functions.at(k);
      text += number_text(instant.time_ms) + "," + quoted(f.frame) +
              (f.local_axes ? ",local," : ",cartesian,") + f.function;
      for (const double c : instant.frame_unknowns[k]) text += "," + exact_text(c);
      text += '\n';
    }
  }
  return text;
}

std::string cavity_table(const BeatResult& result) {
  std::string text = "time_ms,ventricle,volume_mL,pressure_mmHg,phase\n";
  for (const VentricleSummary& ventricle : result.ventricles) {
    for (const CavitySample& s : ventricle.samples) {
      text += number_text(s.time_ms) + "," + quoted(ventricle.name);
      append(text, {s.volume_mL, s.pressure_mmHg});
      text += "," + (result.has_beat ? phase_name(s.phase) : "") + "\n";
    }
  }
  return text;
}

std::string circulation_text(const BeatResult& result) {
  const CirculationTable& table = result.circulation;
  std::string text;
  for (const std::string& name : table.columns) text += (text.empty() ? "" : ",") + name;
  text += '\n';
  const std::size_t rows = table.values.empty() ? 0 : table.values.front().size();
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < table.values.size(); ++column)
      text += (column > 0 ? "," : "") + number_text(table.values[column].at(row));
    text += '\n';
  }
  return text;
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
  polyaffine::write_atomically(out / "cavity.csv", cavity_table(result));
  if (!result.circulation.columns.empty())
    polyaffine::write_atomically(out / "circulation.csv", circulation_text(result));
  polyaffine::write_atomically(out / "summary.json", summary);
}

}  // namespace cardiac
