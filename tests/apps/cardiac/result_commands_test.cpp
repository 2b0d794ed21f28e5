#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cardiac/report/tables.hpp>
#include "cardiac/report/synthetic_result.hpp"
#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class ResultCommands : public ::testing::Test {
 protected:
  ResultCommands() {
    cardiac::write_tables(cardiac::test::synthetic_beat(), cardiac::test::synthetic_info(), folder());
  }
  fs::path folder() const { return temporary_.path / "run"; }

 private:
  TemporaryFolder temporary_;
};

TEST_F(ResultCommands, StrainPrintsTheTablesOfTheRun) {
  const ProgramRun strain = run_program("strain " + folder().string());
  ASSERT_EQ(strain.status, 0) << strain.err;
  EXPECT_EQ(strain.out, whole_file(folder() / "strain.csv"));
  EXPECT_EQ(run_program("strain " + folder().string() + " --peaks").out,
            whole_file(folder() / "strain_peaks.csv"));
  const fs::path out = folder() / "frames.csv";
  const ProgramRun frames = run_program("strain " + folder().string() + " --frames --out " + out.string());
  ASSERT_EQ(frames.status, 0) << frames.err;
  EXPECT_THAT(frames.out, IsEmpty());
  EXPECT_EQ(whole_file(out), whole_file(folder() / "affine.csv"));
}

TEST_F(ResultCommands, ReportIsMadeFromTheFilesAlone) {
  const ProgramRun report = run_program("report " + folder().string());
  ASSERT_EQ(report.status, 0) << report.err;
  EXPECT_THAT(report.out, HasSubstr("report.html"));
  EXPECT_THAT(whole_file(folder() / "report.html"), StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(whole_file(folder() / "pv_loop.svg"), StartsWith("<svg "));
}

TEST_F(ResultCommands, WrongInputEndsWithStatusTwoAndNamesThePlace) {
  const ProgramRun missing = run_program("strain " + (folder() / "none").string());
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("no such folder"));
  EXPECT_EQ(run_program("strain " + folder().string() + " --frames --peaks").status, 2);
  fs::remove(folder() / "cavity.csv");
  const ProgramRun incomplete = run_program("report " + folder().string());
  EXPECT_EQ(incomplete.status, 2);
  EXPECT_THAT(incomplete.err, HasSubstr("cavity.csv: no such file"));
}

}  // namespace
