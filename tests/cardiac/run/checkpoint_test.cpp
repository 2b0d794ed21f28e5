#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include <cardiac/run/checkpoint.hpp>
#include <polyaffine/core/error.hpp>

#include "support/file_fuzz.hpp"
#include "support/temporary_folder.hpp"

namespace cardiac {
namespace {

const CheckpointOrigin origin{"1.0", R"({"time": {"max_beats": 5}, "tissue": {"C_kPa": 2.0}})", "3 tets"};

Checkpoint two_beats() {
  Checkpoint out;
  out.beats = 2;
  out.time_steps = 300;
  out.newton_iterations = 700;
  out.stroke_volumes_mm3 = {6e4, 1.0 / 3};
  out.cycle = {
      {polyaffine::Vector::LinSpaced(2, 9, 1.0 / 7), polyaffine::Vector::LinSpaced(2, 9, 1.0 / 3), 6e4},
      {polyaffine::Vector::LinSpaced(2, 8, 0.1), polyaffine::Vector::LinSpaced(2, 8, 0.3), 1.0 / 3}};
  out.min_det_F = 0.9;
  out.cost.residuals = 1200;
  out.y = polyaffine::Vector::LinSpaced(7, -1, 1e-30);
  out.rate = polyaffine::Vector::LinSpaced(7, 0, 1.0 / 7);
  return out;
}

class CheckpointFile : public ::testing::Test {
 protected:
  void write(const std::string& text) const { std::ofstream(file) << text; }
  TemporaryFolder folder;
  std::filesystem::path file = folder.path / "checkpoint.json";
};

TEST_F(CheckpointFile, GivesBackEveryBit) {
  const Checkpoint at = two_beats();
  write(checkpoint_text(at, origin));
  const Checkpoint read = read_checkpoint(file, origin);
  EXPECT_EQ(read.y, at.y);
  EXPECT_EQ(read.rate, at.rate);
  EXPECT_EQ(read.stroke_volumes_mm3, at.stroke_volumes_mm3);
  ASSERT_EQ(read.cycle.size(), 2U);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(read.cycle[k].start, at.cycle[k].start);
    EXPECT_EQ(read.cycle[k].end, at.cycle[k].end);
    EXPECT_EQ(read.cycle[k].stroke_mm3, at.cycle[k].stroke_mm3);
  }
  EXPECT_EQ(checkpoint_text(read, origin), checkpoint_text(at, origin));
}

TEST_F(CheckpointFile, ADamagedOneIsRefused) {
  const std::string text = checkpoint_text(two_beats(), origin);
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string damaged = text;
    damaged.replace(damaged.find(from), from.size(), to);
    write(damaged);
    try {
      read_checkpoint(file, origin);
    } catch (const polyaffine::InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  using ::testing::HasSubstr;
  EXPECT_EQ(refusal("300", "300"), "accepted");
  EXPECT_THAT(refusal("300", "1e300"), HasSubstr("time_steps"));
  EXPECT_THAT(refusal("\"beats\":2", "\"beats\":-2"), HasSubstr("beats"));
  EXPECT_THAT(refusal("\"beats\":2", "\"beats\":3"), HasSubstr("differ in number"));
  EXPECT_THAT(refusal("\"y\":[", "\"y\":[1,"), HasSubstr("differ in length"));
  EXPECT_THAT(refusal("\"start\":[", "\"start\":[1,"), HasSubstr("cycle differ in length"));
  EXPECT_THAT(refusal("3 tets", "4 tets"), HasSubstr("mesh: found 4 tets, expected 3 tets"));
}

TEST_F(CheckpointFile, ChangedAtRandomIsReadOrRefused) {
  write(checkpoint_text(two_beats(), origin));
  expect_read_or_refused(file, {"{", "}", "[", "]", ",", ":", "\"", "null", "-", "e", "\"y\":", "\\ud800"},
                         2000, [&] { read_checkpoint(file, origin); });
}

}  // namespace
}  // namespace cardiac
