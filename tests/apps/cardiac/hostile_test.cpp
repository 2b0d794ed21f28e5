#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "program.hpp"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kEvil = "<script>alert(1)</script>";

/// A passive inflation whose names are markup.
fs::path protocol(const fs::path& folder) {
  const fs::path mesh = folder / "<img src=x onerror=alert(1)>.vtu";
  fs::copy_file(PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu", mesh);
  const fs::path file = folder / "hostile.toml";
  std::ofstream(file)
      << "[mesh]\nfile = \"" << mesh.filename().string()
      << "\"\nlength_unit = \"mm\"\n[tissue]\nlaw = \"neo_hookean\"\n[cavities]\npressure_mmHg = 1\n"
         "[time]\nload_steps = 2\n[[region]]\nname = \""
      << kEvil << "\"\nsegments = [7]\nstiffness_factor = 2\n";
  return file;
}

std::set<fs::path> content(const fs::path& folder) {
  std::set<fs::path> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) out.insert(entry.path());
  return out;
}

TEST(Hostile, NamesAreTextInThePageAndNothingIsWrittenElsewhere) {
  const TemporaryFolder folder;
  const fs::path file = protocol(folder.path), out = folder.path / "<script>alert(2)<b>";
  const auto before = content(folder.path);
  const ProgramRun run = run_program("run " + file.string() + " --out \"" + out.string() + "\"");
  ASSERT_EQ(run.status, 0) << run.err;
  for (const fs::path& found : content(folder.path))
    EXPECT_TRUE(before.contains(found) || found.string().starts_with(out.string())) << found;
  int pages = 0;
  for (const auto& entry : fs::directory_iterator(out)) {
    if (entry.path().extension() != ".html" && entry.path().extension() != ".svg") continue;
    ++pages;
    for (const char* markup : {"<script", "<img", "<b>"})
      EXPECT_THAT(whole_file(entry.path()), Not(HasSubstr(markup))) << entry.path();
  }
  EXPECT_GE(pages, 3);
  EXPECT_THAT(whole_file(out / "report.html"), HasSubstr("&lt;script&gt;alert(1)"));
  EXPECT_THAT(whole_file(out / "report.html"), HasSubstr("&lt;script&gt;alert(2)"));
}

// A limit on the size of files makes a write fail as a full disk does.
TEST(Hostile, AFullDiskIsToldAndLeavesNoHalfFile) {
  const TemporaryFolder folder;
  const fs::path file = protocol(folder.path), out = folder.path / "out";
  const fs::path script = folder.path / "limited.sh";
  std::ofstream(script) << "trap '' XFSZ\nulimit -f 4\nexec \"" CARDIAC_PROGRAM "\" run " << file
                        << " --quiet --out " << out << " 2>" << folder.path / "err"
                        << "\n";
  EXPECT_EQ(WEXITSTATUS(std::system(("sh " + script.string()).c_str())), 1);
  EXPECT_THAT(whole_file(folder.path / "err"), HasSubstr("cardiac: error: "));
  EXPECT_THAT(whole_file(folder.path / "err"), HasSubstr("to its end: File too large"));
  EXPECT_FALSE(fs::exists(out / "summary.json"));
  for (const auto& entry : fs::directory_iterator(out))
    EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << entry.path();
}

TEST(Hostile, AFullStandardOutputIsAnError) {
  const TemporaryFolder folder;
  const fs::path err = folder.path / "err";
  const int code = std::system(("\"" CARDIAC_PROGRAM "\" schema >/dev/full 2>" + err.string()).c_str());
  EXPECT_EQ(WEXITSTATUS(code), 1);
  EXPECT_THAT(whole_file(err), HasSubstr("cardiac: error: cannot write to the standard output"));
}

}  // namespace
