#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <limits>

#include <cardiac/report/csv_reader.hpp>
#include <cardiac/report/result_reader.hpp>
#include <cardiac/report/tables.hpp>
#include <polyaffine/core/error.hpp>
#include "cardiac/report/synthetic_result.hpp"

namespace cardiac {
namespace {

using ::testing::HasSubstr;

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const polyaffine::InputError& error) {
    return error.what();
  }
  return "no InputError";
}

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
    return message_of([&] { read_result(folder()); });
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
  EXPECT_THAT(message_of([&] { read_result(folder() / "none"); }), HasSubstr("none: no such folder"));
  EXPECT_THAT(message_of([&] { read_result(folder() / "strain.csv"); }), HasSubstr("is not a folder"));
  std::filesystem::remove(folder() / "affine.csv");
  EXPECT_THAT(message_of([&] { read_result(folder()); }), HasSubstr("affine.csv: no such file"));
}

TEST_F(ResultReader, NamesLineAndColumnOfABadTable) {
  EXPECT_THAT(message_after("strain.csv", "\n10,3,", "\n10,three,"),
              HasSubstr("strain.csv:21, column 'segment': found 'three', expected an integer"));
}

TEST_F(ResultReader, NamesABadNumber) {
  EXPECT_THAT(message_after("cavity.csv", "\n5,lv,121.4,", "\n5,lv,1x,"),
              HasSubstr("cavity.csv:3, column 'volume_mL': found '1x', expected a number"));
}

TEST_F(ResultReader, NamesABadPhase) {
  EXPECT_THAT(message_after("cavity.csv", "ejection", "ejecting"),
              HasSubstr("column 'phase': found 'ejecting', expected filling,"));
}

TEST_F(ResultReader, NamesAnUnknownVentricle) {
  EXPECT_THAT(message_after("cavity.csv", "\n0,lv,", "\n0,la,"), HasSubstr("column 'ventricle': found 'la'"));
}

TEST_F(ResultReader, NamesAMissingColumn) {
  EXPECT_THAT(message_after("affine.csv", "a_22", "b_22"), HasSubstr("affine.csv:1: the column 'a_22'"));
}

TEST_F(ResultReader, NamesARowThatIsTooShort) {
  EXPECT_THAT(message_after("strain.csv", "\n0,2,basal anteroseptal,0", "\n0,2,basal anteroseptal"),
              HasSubstr("strain.csv:3: found 9 fields, expected 10"));
}

TEST_F(ResultReader, NamesAMissingSegment) {
  EXPECT_THAT(message_after("strain.csv", "0,2,basal anteroseptal,0,0,0,0,0,0,1\n", ""),
              HasSubstr("strain.csv:3, column 'segment': found '3', expected segment 2"));
}

TEST_F(ResultReader, NamesTablesThatDoNotBelongTogether) {
  EXPECT_THAT(message_after("affine.csv", "\n0,1,basal anterior", "\n1,1,basal anterior"),
              HasSubstr("affine.csv:2, column 'time_ms': found '1', expected a time that strain.csv has"));
}

TEST_F(ResultReader, NamesABadGlobalStrain) {
  EXPECT_THAT(
      message_after("global_strain.csv", "\n10,lv,", "\n11,lv,"),
      HasSubstr("global_strain.csv:3, column 'time_ms': found '11', expected a time that strain.csv"));
  EXPECT_THAT(message_after("global_strain.csv", "\n0,lv,", "\n0,rv,"),
              HasSubstr("global_strain.csv:2, column 'ventricle': found 'rv', expected the ventricles"));
}

TEST_F(ResultReader, NamesKeysOfABadSummary) {
  EXPECT_THAT(message_after("summary.json", "\"gls_percent\": -18.42", "\"gls_percent\": \"x\""),
              HasSubstr("summary.json: 'strain.gls_percent' is string, expected a number or null"));
}

TEST_F(ResultReader, NamesMissingKeysOfASummary) {
  EXPECT_THAT(message_after("summary.json", "\"tets\"", "\"tet\""),
              HasSubstr("summary.json: the key 'mesh.tets' is missing"));
}

TEST_F(ResultReader, RejectsWhatIsNotJson) {
  EXPECT_THAT(message_after("summary.json", "{", "["), HasSubstr("summary.json: not valid JSON"));
}

}  // namespace
}  // namespace cardiac
