#include "cardiac/report/csv_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cardiac {
namespace {

TEST(CsvWriter, WritesFieldsOfEveryKind) {
  CsvWriter csv("name,count,value,settings");
  csv << "plain" << 3 << 0.1 + 0.2;
  csv.quoted("");
  csv.end_row();
  csv << std::string("a \"b\", c") << -1L << std::nan("");
  csv.quoted("x");
  csv.end_row();
  EXPECT_EQ(csv.text(),
            "name,count,value,settings\n"
            "plain,3,0.3,\"\"\n"
            "\"a \"\"b\"\", c\",-1,,\"x\"\n");
}

TEST(CsvWriter, ShowsAsManyDigitsAsAsked) {
  CsvWriter csv("pi", 4);
  csv << 3.14159265358979;
  csv.end_row();
  EXPECT_EQ(csv.text(), "pi\n3.142\n");
}

}  // namespace
}  // namespace cardiac
