#include "cardiac/protocol/given_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include <cardiac/activation/activation.hpp>
#include <cardiac/core/csv_reader.hpp>
#include <cardiac/core/given_curve.hpp>
#include <cardiac/core/units.hpp>
#include <cardiac/protocol/key.hpp>
#include <polyaffine/core/error.hpp>

namespace cardiac::protocol {
namespace {

using polyaffine::InputError;

/// A name that a column may have, and one of its units in that of a scene.
struct Spelling {
  std::string name;
  double factor;
};

/// A column of numbers that has one of some names.
class Column {
 public:
  Column(const CsvTable& table, const std::string& file, const std::vector<Spelling>& spellings)
      : table_(table) {
    std::string expected, found;
    for (const Spelling& spelling : spellings) {
      expected += (expected.empty() ? "" : " or ") + spelling.name;
      const auto& columns = table.columns();
      if (std::ranges::find(columns, spelling.name) == columns.end()) continue;
      index_ = table.column(spelling.name);
      factor_ = spelling.factor;
      return;
    }
    for (const std::string& name : table.columns()) found += (found.empty() ? "" : ", ") + name;
    throw InputError(file + ":1: found the columns " + found + ", expected one named " + expected);
  }

  /// In the unit of a scene.
  double operator()(std::size_t row) const {
    const double value = table_.number(row, index_);
    if (!std::isfinite(value)) table_.fail(row, index_, "a number");
    return value * factor_;
  }
  double factor() const { return factor_; }
  [[noreturn]] void fail(std::size_t row, const std::string& expected) const {
    table_.fail(row, index_, expected);
  }

 private:
  const CsvTable& table_;
  std::size_t index_ = 0;
  double factor_ = 1;
};

const std::vector<Spelling> kTime{{"time_ms", 1}, {"time_s", ms_per_s}};

struct Samples {
  std::vector<double> times_ms, values;
};

/// Adds a sample behind the others.
void add(Samples& samples, const Column& time, std::size_t row, double value) {
  const double t = time(row);
  if (!samples.times_ms.empty() && !(t > samples.times_ms.back()))
    time.fail(row, "more than the row before it, " + number_text(samples.times_ms.back() / time.factor()));
  samples.times_ms.push_back(t);
  samples.values.push_back(value);
}

double longest_gap(const std::vector<double>& times) {
  double longest = 0;
  for (std::size_t i = 1; i < times.size(); ++i) longest = std::max(longest, times[i] - times[i - 1]);
  return longest;
}

/// A curve of a table: one beat, repeated, or the whole of `whole_ms`.
GivenCurve curve_of(Samples samples, Repeats repeats, double beat_ms, double whole_ms,
                    const std::string& file, const std::string& what) {
  const std::string told = file + ": " + what + ": ";
  if (samples.times_ms.size() < 2)
    throw InputError(told + "found " + std::to_string(samples.times_ms.size()) +
                     " rows, expected at least two");
  const double begin = samples.times_ms.front(), length = samples.times_ms.back() - begin;
  const double slack = 1e-6 * beat_ms;
  const bool fits = length <= beat_ms + slack;
  std::ostringstream span;
  span << "found rows from " << begin << " to " << samples.times_ms.back() << " ms, expected ";
  if (repeats == Repeats::yes || (repeats == Repeats::automatic && fits)) {
    const double missing = beat_ms - length;
    if (!fits || missing > longest_gap(samples.times_ms) + slack)
      throw InputError(told + span.str() + "one beat of " + number_text(beat_ms) +
                       " ms (60000/time.heart_rate_bpm)" +
                       (repeats == Repeats::automatic ? ", or all of time.duration_ms" : ""));
    return GivenCurve::through(std::move(samples.times_ms), std::move(samples.values), beat_ms);
  }
  if (begin > slack || samples.times_ms.back() < whole_ms - slack)
    throw InputError(
        told + span.str() + "all of 0 to " + number_text(whole_ms) + " ms (time.duration_ms)" +
        (repeats == Repeats::automatic ? ", or one beat of " + number_text(beat_ms) + " ms" : ""));
  return GivenCurve::through(std::move(samples.times_ms), std::move(samples.values));
}

/// The path of a file that a key names; it must be there.
std::string file_of(const Protocol& protocol, const std::string& name, const std::string& key,
                    const Place& place) {
  const std::filesystem::path file = (protocol.directory / name).lexically_normal();
  if (!std::filesystem::is_regular_file(file))
    throw InputError(place(key) + ": " + key + ": no such file " + file.string() +
                     "; expected a table (.csv), its path relative to the protocol file");
  return file.string();
}

void read_cavities(Protocol& protocol, const Place& place) {
  Cavities& cavities = *protocol.cavities;
  const bool volumes = cavities.volume_file.has_value();
  const std::string key = volumes ? "cavities.volume_file" : "cavities.pressure_file";
  const std::string file =
      file_of(protocol, volumes ? *cavities.volume_file : *cavities.pressure_file, key, place);
  const CsvTable table{file};
  const Column time(table, file, kTime);
  const Column value(table, file,
                     volumes ? std::vector<Spelling>{{"volume_mL", mm3_per_mL}, {"volume_mm3", 1}}
                             : std::vector<Spelling>{{"pressure_mmHg", kPa_per_mmHg}, {"pressure_kPa", 1}});
  const bool named = std::ranges::find(table.columns(), "ventricle") != table.columns().end();
  std::array<Samples, 2> samples;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string side = named ? table.text(row, table.column("ventricle")) : "lv";
    if (side != "lv" && side != "rv") table.fail(row, table.column("ventricle"), "lv or rv");
    const double v = value(row);
    if (volumes && !(v > 0)) value.fail(row, "a volume above 0 mL");
    if (!volumes && !(std::abs(v) <= 1000 * kPa_per_mmHg)) value.fail(row, "a pressure of at most 1000 mmHg");
    add(samples[side == "lv" ? 0 : 1], time, row, v);
  }
  const bool two = protocol.anatomy.scheme == Scheme::aha29;
  GivenCavities given;
  given.are_volumes = volumes;
  const double whole = protocol.time.duration_ms, beat = protocol.time.beat_ms;
  given.curves.push_back(curve_of(std::move(samples[0]), cavities.repeats, beat, whole, file, "lv"));
  if (two && (volumes || !samples[1].times_ms.empty()))
    given.curves.push_back(curve_of(std::move(samples[1]), cavities.repeats, beat, whole, file, "rv"));
  cavities.curves = std::make_shared<const GivenCavities>(std::move(given));
}

void read_tension(Protocol& protocol, const Place& place) {
  Contraction& contraction = *protocol.contraction;
  const std::string key = "contraction.tension_file";
  if (!contraction.tension_file)
    throw InputError(place("contraction.model") + ": " + key +
                     ": missing; expected a table (.csv) with time_ms and tension_kPa");
  const std::string file = file_of(protocol, *contraction.tension_file, key, place);
  const CsvTable table{file};
  const Column time(table, file, kTime);
  const Column tension(table, file, {{"tension_kPa", 1}, {"tension_Pa", 1e-3}});
  Samples samples;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double value = tension(row);
    if (!(value >= 0 && value <= 2000)) tension.fail(row, "a tension of 0 to 2000 kPa");
    add(samples, time, row, value);
  }
  GivenCurve curve = curve_of(std::move(samples), Repeats::automatic, protocol.time.beat_ms,
                              protocol.time.duration_ms, file, "tension");
  if (!curve.repeats && protocol.circulation)
    throw InputError(file + ": tension: found more than a beat, expected one beat of " +
                     number_text(protocol.time.beat_ms) + " ms: with a circulation beats repeat");
  contraction.tension = std::make_shared<const GivenCurve>(std::move(curve));
}

void read_calcium(Protocol& protocol, const Place& place) {
  Contraction& contraction = *protocol.contraction;
  const std::string file = file_of(protocol, *contraction.calcium_file, "contraction.calcium_file", place);
  const CsvTable table{file};
  const Column time(table, file, kTime);
  const Column calcium(table, file, {{"calcium_uM", 1}, {"calcium_nM", 1e-3}, {"calcium_mM", 1e3}});
  Samples samples;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double value = calcium(row);
    if (!(value >= 0 && value <= 100)) calcium.fail(row, "a concentration of 0 to 100 uM");
    add(samples, time, row, value);
  }
  contraction.calcium = std::make_shared<const GivenCurve>(curve_of(
      std::move(samples), Repeats::yes, protocol.time.beat_ms, protocol.time.duration_ms, file, "calcium"));
}

void read_times(Protocol& protocol, const Place& place) {
  Activation& activation = *protocol.activation;
  const std::string file = file_of(protocol, *activation.file, "activation.times_file", place);
  const CsvTable table{file};
  std::vector<Column> axes;
  for (const std::string axis : {"x", "y", "z"})
    axes.emplace_back(table, file,
                      std::vector<Spelling>{{axis + "_mm", 1}, {axis + "_cm", 10}, {axis + "_m", 1000}});
  const Column time(table, file, {{"activation_ms", 1}, {"activation_s", ms_per_s}});
  if (table.rows() == 0) throw InputError(file + ": found no rows, expected at least one point");
  ActivationMap map;
  map.points.resize(3, static_cast<Eigen::Index>(table.rows()));
  map.times_ms.resize(static_cast<Eigen::Index>(table.rows()));
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto i = static_cast<Eigen::Index>(row);
    for (Eigen::Index k = 0; k < 3; ++k) map.points(k, i) = axes[static_cast<std::size_t>(k)](row);
    map.times_ms[i] = time(row);
    if (std::abs(map.times_ms[i]) > 1e5) time.fail(row, "a time of at most 100000 ms");
  }
  activation.map = std::make_shared<const ActivationMap>(std::move(map));
}

}  // namespace

void read_given_files(Protocol& protocol, const Place& place) {
  if (protocol.cavities && (protocol.cavities->pressure_file || protocol.cavities->volume_file))
    read_cavities(protocol, place);
  if (protocol.contraction && protocol.contraction->model == ContractionModel::table)
    read_tension(protocol, place);
  if (protocol.contraction && protocol.contraction->model == ContractionModel::land_2017 &&
      protocol.contraction->calcium_file)
    read_calcium(protocol, place);
  if (protocol.activation && protocol.activation->mode == ActivationMode::table) read_times(protocol, place);
}

}  // namespace cardiac::protocol
