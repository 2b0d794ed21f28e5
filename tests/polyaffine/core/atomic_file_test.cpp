#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <random>

#include <polyaffine/core/atomic_file.hpp>
#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

namespace fs = std::filesystem;

class AtomicFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("atomic_" + std::to_string(std::random_device{}()));
    make_folder(folder / "a" / "b");
    target = folder / "table.csv";
  }
  void TearDown() override { fs::remove_all(folder); }

  static std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  long files() const {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator()) - 1;  // the folder a
  }

  fs::path folder, target;
};

TEST_F(AtomicFile, IsMadeAndReplacedWhole) {
  write_atomically(target, "old\n");
  EXPECT_EQ(content(target), "old\n");
  write_atomically(target, "a longer new one\n");
  EXPECT_EQ(content(target), "a longer new one\n");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFile, FailingWriterLeavesTheOldFileAndNothingElse) {
  write_atomically(target, "old");
  const auto half = [](const fs::path& path) {
    std::ofstream(path) << "half";
    throw std::runtime_error("stopped");
  };
  EXPECT_THROW(write_atomically(target, half), std::runtime_error);
  EXPECT_THROW(write_atomically(target, [](const fs::path&) {}), ComputationError);
  EXPECT_EQ(content(target), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFile, TemporaryNameIsInTheSameFolderWithTheSameExtension) {
  write_atomically(target, [&](const fs::path& path) {
    EXPECT_EQ(path.parent_path(), folder);
    EXPECT_EQ(path.extension(), ".csv");
    EXPECT_NE(path, target);
    std::ofstream(path) << "x";
  });
  EXPECT_EQ(content(target), "x");
}

TEST_F(AtomicFile, FullDiskIsToldAndLeavesTheOldFile) {
  write_atomically(target, "old");
  // A limit on the size of files makes write() fail as a full disk does.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  std::string message;
  try {
    write_atomically(target, std::string(100000, 'x'));
  } catch (const ComputationError& error) {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(message, ::testing::HasSubstr(target.string()));
  EXPECT_EQ(content(target), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFile, FilesOfKilledWritersAreRemovedAndNoOthers) {
  const pid_t killed = fork();
  if (killed == 0) {
    write_atomically(target, [](const fs::path& path) {
      std::ofstream(path) << "half" << std::flush;
      ::kill(::getpid(), SIGKILL);
    });
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(killed, &status, 0), killed);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_FALSE(fs::exists(target));
  ASSERT_EQ(files(), 1) << "the temporary file";
  std::ofstream(folder / ("other.tmp-" + std::to_string(killed))) << "of the user";
  write_atomically(target, [&](const fs::path& path) {
    std::ofstream(path) << "being written";
    remove_abandoned(folder);
  });
  EXPECT_EQ(content(target), "being written");
  EXPECT_EQ(files(), 2);
}

TEST_F(AtomicFile, MissingFolderAndUnusableTargetAreInputErrorsThatNameThePath) {
  try {
    write_atomically(folder / "none" / "x.csv", "x");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr((folder / "none" / "x.csv").string()));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("No such file"));
  }
  EXPECT_THROW(write_atomically(folder / "a", "x"), InputError);  // a folder that is not empty
  write_atomically(target, "x");
  EXPECT_THROW(make_folder(target), InputError);
  EXPECT_THROW(make_folder(target / "below"), InputError);
  EXPECT_EQ(files(), 1);
}

}  // namespace
}  // namespace polyaffine
