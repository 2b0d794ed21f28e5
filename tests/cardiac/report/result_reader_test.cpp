#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include <cardiac/core/csv_reader.hpp>
#include <cardiac/report/result_reader.hpp>
#include <cardiac/report/tables.hpp>
#include "cardiac/report/synthetic_result.hpp"
#include "support/error_of.hpp"

namespace cardiac {
namespace {

using polyaffine::testing::error_of;
using ::testing::HasSubstr;

class ResultReader : public ::testing::Test {
 protected:
  void SetUp() override { write(test::synthetic_beat(true)); }

  void write(const BeatResult& result) const { write_tables(result, test::synthetic_info(), folder()); }
  const std::filesystem::path& folder() const { return temporary_.path(); }
  /// Replaces the first `from` in a file and gives the message of reading the result.
  std::string message_after(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = read_text(folder() / file);
    const size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    std::ofstream(folder() / file, std::ios::binary) << text.replace(place, from.size(), to);
    return error_of([&] { read_result(folder()); });
  }

 private:
  test::TemporaryFolder temporary_;
};

TEST_F(ResultReader, GivesBackWhatWasWritten) {
  BeatResult r = test::synthetic_beat(true);
  r.completed = false;
  r.stop_reason = "stopped, \"early\"";
  r.warnings = {"<b>", "µ"};
  r.verification = {{"ED", 0, 0.8, 0.4, 0.012, 12.3}};
  r.segments[3].name = "a \"b\", c";
  r.segments[4].activation_ms.reset();
  r.instants[5].frames[6].misfit = std::numeric_limits<double>::quiet_NaN();
  r.right_strain.emplace().longitudinal.epicardial_percent = -17;
  r.instants[5].strain[6].radial = std::numeric_limits<double>::quiet_NaN();
  write(r);
  const auto [result, info] = read_result(folder());
  // The same tables and summary again: every number was read, to all the digits that were written.
  EXPECT_EQ(strain_table(result), strain_table(r));
  EXPECT_EQ(cavity_table(result), cavity_table(r));
  EXPECT_EQ(peaks_table(result), peaks_table(r));
  EXPECT_EQ(affine_table(result), affine_table(r));
  EXPECT_EQ(global_strain_table(result), global_strain_table(r));
  EXPECT_EQ(result.right_strain.value().longitudinal.epicardial_percent, -17);
  ASSERT_EQ(result.instants.size(), r.instants.size());
  EXPECT_EQ(result.stop_reason, r.stop_reason);
  EXPECT_FALSE(result.segments[4].activation_ms.has_value());
  EXPECT_EQ(result.verification.at(0).displacement_error_percent, 0.8);
  EXPECT_EQ(info.seed, 7);
  const std::string before = read_text(folder() / "summary.json");
  write_tables(result, info, folder());
  EXPECT_EQ(read_text(folder() / "summary.json"), before);
}

TEST_F(ResultReader, ReadsTheCirculationWhereItIs) {
  EXPECT_TRUE(read_result(folder()).result.circulation.columns.empty());
  BeatResult r = test::synthetic_beat();
  r.circulation = {{"time_ms", "aorta_mmHg"}, {{0, 2.5}, {80.25, std::numeric_limits<double>::quiet_NaN()}}};
  write(r);
  const CirculationTable back = read_result(folder()).result.circulation;
  EXPECT_EQ(back.columns, r.circulation.columns);
  EXPECT_EQ(back.values.at(1).at(0), 80.25);
  EXPECT_TRUE(std::isnan(back.values.at(1).at(1)));
  EXPECT_THAT(message_after("circulation.csv", "80.25", "x"), HasSubstr("circulation.csv:2"));
}

TEST_F(ResultReader, ReadsARunWithoutCirculationOrWithNothing) {
  BeatResult r = test::synthetic_beat();
  r.has_beat = false;
  write(r);
  EXPECT_TRUE(std::isnan(read_result(folder()).result.ventricles.at(0).ef_percent));
  write(BeatResult{});
  EXPECT_TRUE(read_result(folder()).result.instants.empty());
}

TEST_F(ResultReader, ReadsFullOrderRunsWithoutFrames) {
  BeatResult r = test::synthetic_beat();
  for (Instant& instant : r.instants) instant.frames.clear();
  write(r);
  EXPECT_TRUE(read_result(folder()).result.instants.at(4).frames.empty());
}

TEST_F(ResultReader, NamesWhatIsMissing) {
  EXPECT_THAT(error_of([&] { read_result(folder() / "none"); }), HasSubstr("none: no such folder"));
  EXPECT_THAT(error_of([&] { read_result(folder() / "strain.csv"); }), HasSubstr("is not a folder"));
  std::filesystem::remove(folder() / "affine.csv");
  EXPECT_THAT(error_of([&] { read_result(folder()); }), HasSubstr("affine.csv: no such file"));
}

/// A change in a file of the result, and what the message must say.
struct Fault {
  const char* name;
  const char* file;
  const char *from, *to;
  const char* message;
};

class FaultyResult : public ResultReader, public ::testing::WithParamInterface<Fault> {};

TEST_P(FaultyResult, IsRefusedWithItsPlace) {
  const Fault& fault = GetParam();
  EXPECT_THAT(message_after(fault.file, fault.from, fault.to), HasSubstr(fault.message));
}

INSTANTIATE_TEST_SUITE_P(
    Faults, FaultyResult,
    ::testing::Values(
        Fault{"bad_integer", "strain.csv", "\n10,3,", "\n10,three,",
              "strain.csv:21, column 'segment': found 'three', expected an integer"},
        Fault{"bad_number", "cavity.csv", "\n5,lv,121.4,", "\n5,lv,1x,",
              "cavity.csv:3, column 'volume_mL': found '1x', expected a number"},
        Fault{"bad_phase", "cavity.csv", "ejection", "ejecting",
              "column 'phase': found 'ejecting', expected filling,"},
        Fault{"unknown_ventricle", "cavity.csv", "\n0,lv,", "\n0,la,", "column 'ventricle': found 'la'"},
        Fault{"missing_column", "affine.csv", "a_22", "b_22", "affine.csv:1: the column 'a_22'"},
        Fault{"row_too_short", "strain.csv", "\n0,2,basal anteroseptal,0", "\n0,2,basal anteroseptal",
              "strain.csv:3: found 9 fields, expected 10"},
        Fault{"missing_segment", "strain.csv", "0,2,basal anteroseptal,0,0,0,0,0,0,1\n", "",
              "strain.csv:3, column 'segment': found '3', expected segment 2"},
        Fault{"tables_apart", "affine.csv", "\n0,1,basal anterior", "\n1,1,basal anterior",
              "affine.csv:2, column 'time_ms': found '1', expected a time that strain.csv has"},
        Fault{"global_strain_apart", "global_strain.csv", "\n10,lv,", "\n11,lv,",
              "global_strain.csv:3, column 'time_ms': found '11', expected a time that strain.csv"},
        Fault{"global_strain_of_another", "global_strain.csv", "\n0,lv,", "\n0,rv,",
              "global_strain.csv:2, column 'ventricle': found 'rv', expected the ventricles"},
        Fault{"bad_summary", "summary.json", "\"gls_percent\": -18.42", "\"gls_percent\": \"x\"",
              "summary.json: 'strain.gls_percent' is string, expected a number or null"},
        Fault{"missing_key", "summary.json", "\"tets\"", "\"tet\"",
              "summary.json: the key 'mesh.tets' is missing"},
        Fault{"no_json", "summary.json", "{", "[", "summary.json: not valid JSON"}),
    [](const auto& fault) { return std::string(fault.param.name); });

}  // namespace
}  // namespace cardiac
