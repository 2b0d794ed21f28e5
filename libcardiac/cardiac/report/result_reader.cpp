#include <cardiac/report/result_reader.hpp>

#include <algorithm>
#include <array>

#include <cardiac/core/csv_reader.hpp>
#include <cardiac/report/global_columns.hpp>
#include <cardiac/report/summary_reader.hpp>
#include <cardiac/report/tables.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac {
namespace {

namespace fs = std::filesystem;

/// Calls `read(instant, row)` for every row, the rows of one time and of all segments in their order being
/// one instant; `instant_at` gives the instant of a time, or null where there must not be one.
template <class InstantAt, class Read>
void for_instants(const CsvTable& table, const std::vector<SegmentInfo>& segments, InstantAt instant_at,
                  Read read) {
  const size_t time = table.column("time_ms"), segment = table.column("segment");
  for (size_t row = 0; row < table.rows(); ++row) {
    const size_t position = row % segments.size();
    const double t = table.number(row, time);
    if (position > 0 && table.text(row, time) != table.text(row - 1, time))
      table.fail(
          row, time,
          "the time of the row before: each time has " + std::to_string(segments.size()) + " segments");
    if (table.integer(row, segment) != segments[position].number)
      table.fail(row, segment, "segment " + std::to_string(segments[position].number));
    Instant* instant = instant_at(row / segments.size(), t);
    if (instant == nullptr) table.fail(row, time, "a time that strain.csv has at this place");
    read(*instant, row);
  }
  if (table.rows() % segments.size() != 0)
    table.fail(table.rows() - 1, segment, "segments up to " + std::to_string(segments.back().number));
}

void expect_no_rows(const CsvTable& table) {
  if (table.rows() > 0) table.fail(0, table.column("segment"), "no rows: summary.json names no segments");
}

void read_strain(const fs::path& file, BeatResult& result) {
  const CsvTable table(file);
  if (result.segments.empty()) return expect_no_rows(table);
  const std::array columns{table.column("longitudinal"), table.column("circumferential"),
                           table.column("radial"),       table.column("shear_lc"),
                           table.column("shear_lr"),     table.column("shear_cr"),
                           table.column("volume_ratio")};
  const auto add_instant = [&](size_t index, double t) {
    if (index == result.instants.size()) result.instants.emplace_back().time_ms = t;
    return &result.instants[index];
  };
  for_instants(table, result.segments, add_instant, [&](Instant& instant, size_t row) {
    const auto value = [&](int i) { return table.number(row, columns[i]); };
    instant.strain.push_back({value(0), value(1), value(2), value(3), value(4), value(5), value(6)});
  });
}

void read_frames(const fs::path& file, BeatResult& result) {
  const CsvTable table(file);
  if (result.segments.empty()) return expect_no_rows(table);
  const auto known_instant = [&](size_t index, double t) -> Instant* {
    const bool known = index < result.instants.size() && result.instants[index].time_ms == t;
    return known ? &result.instants[index] : nullptr;
  };
  for_instants(table, result.segments, known_instant, [&](Instant& instant, size_t row) {
    SegmentFrame& frame = instant.frames.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const std::string number = std::to_string(i + 1);
      frame.t(i) = table.number(row, table.column("t_" + number + "_mm"));
      for (int j = 0; j < 3; ++j)
        frame.A(i, j) = table.number(row, table.column("a_" + number + std::to_string(j + 1)));
    }
    frame.misfit = table.number(row, table.column("misfit"));
  });
}

void read_global(const fs::path& file, BeatResult& result) {
  const CsvTable table(file);
  const size_t time = table.column("time_ms"), ventricle = table.column("ventricle");
  std::vector<size_t> columns;
  for (const GlobalColumn& quantity : kGlobalStrain) columns.push_back(table.column(quantity.column));
  const size_t count = result.ventricles.size();
  for (size_t row = 0; row < table.rows(); ++row) {
    if (count == 0 || table.text(row, ventricle) != result.ventricles[row % count].name)
      table.fail(row, ventricle, "the ventricles of summary.json in their order");
    const size_t index = row / count;
    if (index >= result.instants.size() || result.instants[index].time_ms != table.number(row, time))
      table.fail(row, time, "a time that strain.csv has at this place");
    GlobalStrain& strain = result.instants[index].global.emplace_back();
    for (size_t k = 0; k < columns.size(); ++k)
      kGlobalStrain[k].value(strain) = table.number(row, columns[k]);
  }
}

void read_cavities(const fs::path& file, BeatResult& result) {
  const CsvTable table(file);
  const size_t time = table.column("time_ms"), ventricle = table.column("ventricle"),
               volume = table.column("volume_mL"), pressure = table.column("pressure_mmHg"),
               phase = table.column("phase");
  constexpr std::array kPhases{Phase::filling, Phase::isovolumetric_contraction, Phase::ejection,
                               Phase::isovolumetric_relaxation};
  for (size_t row = 0; row < table.rows(); ++row) {
    const auto v = std::ranges::find(result.ventricles, table.text(row, ventricle), &VentricleSummary::name);
    if (v == result.ventricles.end()) table.fail(row, ventricle, "a ventricle that summary.json has");
    const auto p = result.has_beat ? std::ranges::find(kPhases, table.text(row, phase), phase_name)
                                   : kPhases.begin();  // without a beat there are none
    if (p == kPhases.end())
      table.fail(row, phase, "filling, isovolumetric_contraction, ejection or isovolumetric_relaxation");
    v->samples.push_back(
        {table.number(row, time), table.number(row, volume), table.number(row, pressure), *p});
  }
}

void read_circulation(const fs::path& file, BeatResult& result) {
  if (!fs::exists(file)) return;
  const CsvTable table(file);
  result.circulation.columns = table.columns();
  for (size_t column = 0; column < table.columns().size(); ++column) {
    std::vector<double>& values = result.circulation.values.emplace_back();
    for (size_t row = 0; row < table.rows(); ++row) values.push_back(table.number(row, column));
  }
}

}  // namespace

StoredResult read_result(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw polyaffine::InputError(folder.string() +
                                 (fs::exists(folder) ? ": is not a folder" : ": no such folder") +
                                 ", expected the result folder of a run");
  StoredResult stored = parse_summary(read_text(folder / "summary.json"), folder / "summary.json");
  read_strain(folder / "strain.csv", stored.result);
  read_frames(folder / "affine.csv", stored.result);
  read_global(folder / "global_strain.csv", stored.result);
  read_cavities(folder / "cavity.csv", stored.result);
  read_circulation(folder / "circulation.csv", stored.result);
  return stored;
}

}  // namespace cardiac
