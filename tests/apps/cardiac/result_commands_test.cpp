#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include <cardiac/report/csv_reader.hpp>
#include <cardiac/report/tables.hpp>
#include "cardiac/report/synthetic_result.hpp"

namespace cardiac {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ResultCommands : public ::testing::Test {
 protected:
  void SetUp() override { write_tables(test::synthetic_beat(), test::synthetic_info(), folder()); }

  fs::path folder() const { return temporary_.path() / "run"; }
  int run(const std::string& arguments) const {
    const std::string command = std::string(CARDIAC_PROGRAM) + " " + arguments + " >" +
                                (temporary_.path() / "stdout").string() + " 2>" +
                                (temporary_.path() / "stderr").string();
    return WEXITSTATUS(std::system(command.c_str()));
  }
  std::string output() const { return read_text(temporary_.path() / "stdout"); }
  std::string errors() const { return read_text(temporary_.path() / "stderr"); }

 private:
  test::TemporaryFolder temporary_;
};

TEST_F(ResultCommands, StrainPrintsTheTablesOfTheRun) {
  ASSERT_EQ(run("strain " + folder().string()), 0) << errors();
  EXPECT_EQ(output(), read_text(folder() / "strain.csv"));
  ASSERT_EQ(run("strain " + folder().string() + " --peaks"), 0) << errors();
  EXPECT_EQ(output(), read_text(folder() / "strain_peaks.csv"));
  const fs::path out = folder() / "frames.csv";
  ASSERT_EQ(run("strain " + folder().string() + " --frames --out " + out.string()), 0) << errors();
  EXPECT_EQ(output(), "");
  EXPECT_THAT(read_text(out), StartsWith("time_ms,segment,name,a_11,"));
}

TEST_F(ResultCommands, ReportIsMadeFromTheFilesAlone) {
  ASSERT_EQ(run("report " + folder().string()), 0) << errors();
  EXPECT_THAT(output(), HasSubstr("report.html"));
  EXPECT_THAT(read_text(folder() / "report.html"), StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(read_text(folder() / "pv_loop.svg"), StartsWith("<svg "));
}

TEST_F(ResultCommands, WrongInputEndsWithStatusTwoAndNamesThePlace) {
  EXPECT_EQ(run("strain " + (folder() / "none").string()), 2);
  EXPECT_THAT(errors(), HasSubstr("no such folder"));
  EXPECT_EQ(run("strain " + folder().string() + " --frames --peaks"), 2);
  fs::remove(folder() / "cavity.csv");
  EXPECT_EQ(run("report " + folder().string()), 2);
  EXPECT_THAT(errors(), HasSubstr("cavity.csv: no such file"));
}

}  // namespace
}  // namespace cardiac
