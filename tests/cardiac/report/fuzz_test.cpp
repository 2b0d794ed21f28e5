#include <gtest/gtest.h>

#include <cardiac/report/result_reader.hpp>
#include <cardiac/report/tables.hpp>
#include "cardiac/report/synthetic_result.hpp"

#include "support/file_fuzz.hpp"

namespace cardiac {
namespace {

// What does not fit is told of the table that is read with it, in the same folder.
class ResultFuzz : public ::testing::TestWithParam<const char*> {};

TEST_P(ResultFuzz, IsReadOrRefused) {
  const test::TemporaryFolder folder;
  write_tables(test::synthetic_beat(true), test::synthetic_info(), folder.path());
  expect_read_or_refused(
      folder.path() / GetParam(),
      {",", "\n", "\"", "nan", "1e999", "{", "}", "[", "]", ":", "null", "true", "\"segments\": [",
       "ejection", "\\ud800", std::string(1, '\0')},
      1000, [&] { read_result(folder.path()); }, folder.path().string());
}

INSTANTIATE_TEST_SUITE_P(Files, ResultFuzz,
                         ::testing::Values("summary.json", "strain.csv", "affine.csv", "global_strain.csv",
                                           "cavity.csv"),
                         [](const auto& file) { return std::filesystem::path(file.param).stem().string(); });

}  // namespace
}  // namespace cardiac
