#include "polyaffine/core/cache.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace polyaffine {
namespace {

class Cache : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder);
    setenv("XDG_CACHE_HOME", folder.c_str(), 1);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("cache_test_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Cache, GivesBackWhatWasStoredUnderTheWholeKey) {
  EXPECT_FALSE(read_cache("thing", "key"));
  const std::string data("bytes\n\0more", 11);
  write_cache("thing", "key", data);
  EXPECT_EQ(read_cache("thing", "key"), data);
  EXPECT_FALSE(read_cache("other", "key"));
  EXPECT_FALSE(read_cache("thing", "another key"));
  write_cache("thing", "key", "new");
  EXPECT_EQ(read_cache("thing", "key"), "new");
  std::filesystem::remove_all(cache_folder());
  EXPECT_FALSE(read_cache("thing", "key"));
}

// As when two keys have the same checksum.
TEST_F(Cache, AnotherKeyInTheFileIsNoHit) {
  write_cache("thing", "key", "data");
  for (const auto& entry : std::filesystem::directory_iterator(cache_folder()))
    std::ofstream(entry.path()) << "3\nkex\ndata";
  EXPECT_FALSE(read_cache("thing", "key"));
}

TEST_F(Cache, AFolderThatCannotBeMadeOnlyCostsTime) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "cardiac") << "a file in its place";
  EXPECT_NO_THROW(write_cache("thing", "key", "data"));
  EXPECT_FALSE(read_cache("thing", "key"));
}

}  // namespace
}  // namespace polyaffine
