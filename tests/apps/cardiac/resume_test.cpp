#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using nlohmann::json;
using testing::HasSubstr;

constexpr int kBeats = 3;
const std::array<std::string, 6> kTables{"strain.csv",        "strain_peaks.csv", "affine.csv",
                                         "global_strain.csv", "cavity.csv",       "circulation.csv"};

class Resume : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(protocol)
        << "[mesh]\nfile = \"" PROJECT_DIR
           "/meshes/land_ellipsoid_coarse.vtu\"\nlength_unit = \"mm\"\n[reduction]\n"
           "ring_nodes = [4]\n[tissue]\nC_kPa = 1\n[fibres]\n[activation]\nonset_ms = 20\n"
           "[contraction]\ncontractility_kPa = 60\ncross_fibre_fraction = 0.4\nactivation_duration_ms = 150\n"
           "[circulation]\n[time]\nheart_rate_bpm = 180\nlimit_cycle_tolerance_percent = "
           "1e-6\nmax_beats = "
        << kBeats << "\n[output]\nfigures = false\nmesh_series = false\n";
  }

  std::string arguments(const fs::path& out, const std::string& more = "") const {
    return "run " + protocol.string() + " --quiet --out " + out.string() + " " + more;
  }

  // Starts the program, waits, sends the signal and returns the status it ended with, −1 when killed.
  int interrupted(const std::string& arguments, const std::function<void()>& wait, int signal) const {
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", ("exec \"" CARDIAC_PROGRAM "\" " + arguments + " >/dev/null 2>&1").c_str(),
            nullptr);
      _exit(127);
    }
    wait();
    kill(child, signal);
    int code = 0;
    waitpid(child, &code, 0);
    return WIFEXITED(code) ? WEXITSTATUS(code) : -1;
  }

  TemporaryFolder folder;
  fs::path protocol = folder.path / "three_beats.toml";
};

json without_times(const fs::path& summary) {
  json found = json::parse(whole_file(summary));
  for (const char* key : {"wall_time_s", "real_time_factor"}) found.erase(key);
  for (auto& [key, value] : found["timing"].items())
    if (key.ends_with("_s")) value = 0;
  return found;
}

void expect_same_results(const fs::path& found, const fs::path& expected) {
  for (const std::string& table : kTables) EXPECT_EQ(whole_file(found / table), whole_file(expected / table));
  EXPECT_EQ(without_times(found / "summary.json"), without_times(expected / "summary.json"));
}

void expect_no_half_file(const fs::path& out) {
  if (!fs::exists(out)) return;
  for (const auto& entry : fs::directory_iterator(out)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    const std::string text = whole_file(entry.path());
    EXPECT_TRUE(text.ends_with('\n')) << name;
    EXPECT_TRUE(entry.path().extension() != ".json" || json::accept(text)) << name;
  }
}

int beats_in(const fs::path& checkpoint) {
  return fs::exists(checkpoint) ? json::parse(whole_file(checkpoint)).at("beats").get<int>() : 0;
}

// Until a run keeps its first beat, or has ended.
void wait_for_beat(const fs::path& out) {
  const auto latest = Clock::now() + std::chrono::seconds(30);
  while (beats_in(out / "checkpoint.json") == 0 && !fs::exists(out / "summary.json") && Clock::now() < latest)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST_F(Resume, KilledAtTenMomentsGivesTheTablesOfTheUninterruptedRun) {
  const fs::path whole = folder.path / "whole";
  const auto begin = Clock::now();
  ASSERT_EQ(run_program(arguments(whole)).status, 0);
  const std::chrono::duration<double> duration = Clock::now() - begin;

  std::mt19937 random(20);
  std::uniform_real_distribution<double> uniform;
  constexpr std::array kSignals{SIGKILL, SIGINT, SIGTERM};
  int taken_up = 0;
  for (int k = 0; k < 10; ++k) {
    const int signal = kSignals[k % kSignals.size()];
    const auto moment = (k + uniform(random)) / 10 * duration;
    const bool after_first_beat = k % 2 == 1;  // however busy the machine is
    SCOPED_TRACE("signal " + std::to_string(signal) + " after " +
                 (after_first_beat ? "the first beat" : std::to_string(moment.count()) + " s"));
    const fs::path out = folder.path / ("out_" + std::to_string(k));
    const int status = interrupted(
        arguments(out), [&] { after_first_beat ? wait_for_beat(out) : std::this_thread::sleep_for(moment); },
        signal);
    expect_no_half_file(out);
    if (status == 1) {
      const json summary = json::parse(whole_file(out / "summary.json"));
      EXPECT_EQ(summary.at("completed"), false);
      EXPECT_THAT(std::string(summary.at("stop_reason")),
                  HasSubstr(signal == SIGINT ? "interrupted by SIGINT" : "interrupted by SIGTERM"));
    }
    taken_up += beats_in(out / "checkpoint.json") > 0;
    const ProgramRun resumed = run_program(arguments(out, "--resume"));
    EXPECT_EQ(resumed.status, 0) << resumed.err;
    expect_same_results(out, whole);
    for (const auto& entry : fs::directory_iterator(out))
      EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << entry.path();
  }
  EXPECT_GT(taken_up, 0) << "no run had come to its second beat";
}

TEST_F(Resume, FullOrder) {
  const std::string fem = "--method fem --set reduction.element_order=1 --set time.max_beats=2";
  const fs::path whole = folder.path / "whole", out = folder.path / "out";
  ASSERT_EQ(run_program(arguments(whole, fem)).status, 0);
  const auto second_beat = [&] { wait_for_beat(out); };
  for (const auto& [signal, status] : {std::pair{SIGKILL, -1}, std::pair{SIGINT, 1}, std::pair{SIGTERM, 1}}) {
    fs::remove_all(out);
    EXPECT_EQ(interrupted(arguments(out, fem), second_beat, signal), status);
    EXPECT_EQ(run_program(arguments(out, fem + " --resume")).status, 0);
    expect_same_results(out, whole);
  }
}

// A run killed in a folder with results leaves neither them nor half of its own.
TEST_F(Resume, KilledOverEarlierResults) {
  const std::string fem = "--method fem --set reduction.element_order=1 --set time.max_beats=2";
  const fs::path whole = folder.path / "whole", out = folder.path / "out";
  ASSERT_EQ(run_program(arguments(whole, fem)).status, 0);
  ASSERT_EQ(run_program(arguments(out, "--set output.figures=true")).status, 0);
  std::ofstream(out / "heart_0000.vtu") << "earlier";
  for (const char* name : {"of_the_user.csv", "heart_lv.vtu"}) std::ofstream(out / name) << "kept";
  fs::remove(out / "checkpoint.json");
  EXPECT_EQ(interrupted(
                arguments(out, fem),
                [&] {
                  while (!fs::exists(out / "checkpoint.json"))
                    std::this_thread::sleep_for(std::chrono::milliseconds(2));
                },
                SIGKILL),
            -1);
  for (const char* name : {"of_the_user.csv", "heart_lv.vtu"}) EXPECT_TRUE(fs::remove(out / name)) << name;
  for (const auto& entry : fs::directory_iterator(out))
    EXPECT_TRUE(entry.path().filename().string().starts_with('.') ||
                entry.path().filename() == "checkpoint.json")
        << entry.path();
  EXPECT_EQ(run_program(arguments(out, fem + " --resume")).status, 0);
  expect_same_results(out, whole);
}

TEST_F(Resume, OnlyTheSameModel) {
  const fs::path out = folder.path / "out";
  ASSERT_EQ(run_program(arguments(out)).status, 0);
  const std::string summary = whole_file(out / "summary.json");
  const auto refused = [&](const std::string& more, const std::string& message) {
    const ProgramRun run = run_program(arguments(out, "--resume " + more));
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr(message));
    EXPECT_EQ(whole_file(out / "summary.json"), summary);
  };
  refused("--set tissue.C_kPa=1.5", "checkpoint.json: protocol/tissue/C_kPa: found 1.0, expected 1.5");
  refused("--set mesh.file=" PROJECT_DIR "/meshes/land_ellipsoid.vtu", "checkpoint.json: mesh: found ");
  refused("--set time.max_beats=2", "holds 2 beats, expected fewer than time.max_beats");
  std::ofstream(out / "checkpoint.json") << "{\"version\": ";
  refused("", "checkpoint.json: found a damaged checkpoint");
}

TEST_F(Resume, MoreBeatsThanAtFirst) {
  const fs::path whole = folder.path / "whole", out = folder.path / "out";
  ASSERT_EQ(run_program(arguments(whole)).status, 0);
  ASSERT_EQ(run_program(arguments(out, "--set time.max_beats=2")).status, 0);
  EXPECT_EQ(run_program(arguments(out, "--resume")).status, 0);
  expect_same_results(out, whole);
}

}  // namespace
