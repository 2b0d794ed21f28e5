#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "program.hpp"

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

namespace {

std::string passive_protocol(const TemporaryFolder& folder, const std::string& mesh) {
  std::filesystem::create_directories(folder.path / "protocols");
  const auto file = folder.path / "protocols" / "passive.toml";
  std::ofstream(file) << "[mesh]\n" + mesh +
                             "\n[tissue]\nlaw = \"neo_hookean\"\n[cavities]\npressure_mmHg = 2\n";
  return "protocols/passive.toml";
}

std::string in(const TemporaryFolder& folder) {
  return "cd \"" + folder.path.string() + "\" && ";
}

const std::regex kOption("(^ +|,)(--?[A-Za-z-]+)");

/// The commands and options that --help lists, found from its text alone: "mesh import" and "--out".
struct Listed {
  std::set<std::string> options, subcommands;
};
Listed listed(const std::string& command) {
  const ProgramRun run = run_program(command + " --help");
  EXPECT_EQ(run.status, 0) << command;
  Listed out;
  std::istringstream lines(run.out);
  bool subcommands = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(' ')) subcommands = line == "Subcommands:";
    std::smatch found;
    if (subcommands && std::regex_search(line, found, std::regex("^  ([a-z]+)( |$)")))
      out.subcommands.insert(found[1]);
    if (std::regex_search(line, std::regex("^ +-")))
      for (std::sregex_iterator it(line.begin(), line.end(), kOption), end; it != end; ++it)
        out.options.insert((*it)[2]);
  }
  return out;
}

/// Every command with its options, from the help of each.
std::map<std::string, Listed> all_commands() {
  std::map<std::string, Listed> all;
  std::vector<std::string> open{""};
  while (!open.empty()) {
    const std::string command = open.back();
    open.pop_back();
    const Listed& found = all[command] = listed(command);
    for (const std::string& name : found.subcommands)
      open.push_back(command.empty() ? name : command + ' ' + name);
  }
  return all;
}

/// What bash offers for a command line, the last word being typed.
std::set<std::string> completed(const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  const auto script = folder.path / "complete.sh";
  std::string typed;
  for (const std::string& word : words) typed += " \"" + word + '"';
  std::ofstream(script) << "source <(\"" CARDIAC_PROGRAM "\" completion bash)\nCOMP_WORDS=(cardiac" << typed
                        << ")\nCOMP_CWORD=" << words.size()
                        << "\n_cardiac\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n";
  const auto out = folder.path / "out";
  EXPECT_EQ(std::system(("bash " + script.string() + " >" + out.string()).c_str()), 0);
  std::istringstream lines(whole_file(out));
  std::set<std::string> offered;
  for (std::string line; std::getline(lines, line);) offered.insert(line);
  return offered;
}

TEST(Words, HelpIsThatOfTheOption) {
  EXPECT_EQ(run_program("help").out, run_program("--help").out);
  EXPECT_EQ(run_program("help run").out, run_program("run --help").out);
  EXPECT_EQ(run_program("help mesh import").out, run_program("mesh import --help").out);
  EXPECT_EQ(run_program("-V").out, run_program("--version").out);
  const ProgramRun unknown = run_program("help rum");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("unknown subcommand rum of cardiac; the nearest is run\n"));
  EXPECT_THAT(run_program("help run twice").err, HasSubstr("cardiac run has no subcommands"));
}

TEST(Words, UnknownWordsAreNamedWithTheNearest) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"vaildate all", "unknown subcommand vaildate of cardiac; the nearest is validate\n"},
      {"seg", "unknown subcommand seg of cardiac; the nearest is segment\n"},
      {"dance", "unknown subcommand dance of cardiac; there are run, reduce, mesh, segment, "},
      {"mesh elipsoid --out x.vtu",
       "unknown subcommand elipsoid of cardiac mesh; the nearest is ellipsoid\n"},
      {"mesh", "a subcommand of cardiac mesh is missing, expected one of ellipsoid, biventricle, import\n"},
      {"run x.toml --verfiy", "unknown option --verfiy of cardiac run; the nearest is --verify\n"},
      {"run --verfiy", "unknown option --verfiy of cardiac run; the nearest is --verify\n"},
      {"run x.toml --methd=fem", "unknown option --methd of cardiac run; the nearest is --method\n"},
      {"check x.toml --picture", "unknown option --picture of cardiac check; its options are "},
      {"--versoin", "unknown option --versoin of cardiac; the nearest is --version\n"},
      {"schema extra", "unexpected argument extra of cardiac schema\n"},
      {"run", "PROTOCOL is required"},
      {"run x.toml --method magic", "--method: magic not in {polyaffine,fem}"}};
  for (const auto& [arguments, expected] : cases) {
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.status, 2) << arguments;
    EXPECT_THAT(run.out, IsEmpty()) << arguments;
    EXPECT_THAT(run.err, StartsWith("cardiac: error: " + expected)) << arguments;
  }
}

TEST(Words, NothingIsAnsweredWithTheHelp) {
  const ProgramRun run = run_program("");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_THAT(run.err, AllOf(StartsWith("cardiac: error: a subcommand of cardiac is missing"),
                             HasSubstr(run_program("--help").out)));
}

TEST(Words, ExplainListsTablesAndFindsWords) {
  const ProgramRun tables = run_program("explain");
  EXPECT_EQ(tables.status, 0) << tables.err;
  for (const char* table : {"[mesh]", "[reduction]", "[circulation]", "[[region]]", "[output]"})
    EXPECT_THAT(tables.out, HasSubstr(std::string("\n  ") + table + ' '));
  const ProgramRun found = run_program("explain sigmoid");
  EXPECT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.out, AllOf(HasSubstr("reduction.weights "), HasSubstr("reduction.sigmoid_slope "),
                               Not(HasSubstr("time."))));
  // A single key is explained; letters' case and the words' order do not count.
  const ProgramRun one = run_program("explain SLOPE sigmoid");
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(one.out, run_program("explain reduction.sigmoid_slope").out);
  EXPECT_EQ(run_program("explain sigmoid voltage").status, 2);
}

TEST(Words, CompletionKnowsEveryWordOfTheHelp) {
  const auto all = all_commands();
  EXPECT_GE(all.size(), 14U);  // what the interface names, help and completion: the walk found them
  for (const auto& [command, listed] : all) {
    std::istringstream list(command);
    std::vector<std::string> words{std::istream_iterator<std::string>(list), {}};
    words.emplace_back("-");
    EXPECT_EQ(completed(words), listed.options) << command;
    if (listed.subcommands.empty()) continue;
    words.back() = "";
    const auto offered = completed(words);
    EXPECT_TRUE(std::ranges::includes(offered, listed.subcommands)) << command;
  }
  EXPECT_EQ(completed({"run", "x.toml", "--method", ""}), (std::set<std::string>{"polyaffine", "fem"}));
  EXPECT_EQ(completed({"run", "x.toml", "--set", "time.heart"}),
            std::set<std::string>{"time.heart_rate_bpm"});
  EXPECT_EQ(completed({"explain", "time.heart"}), std::set<std::string>{"time.heart_rate_bpm"});
  EXPECT_EQ(completed({"val"}), std::set<std::string>{"validate"});
}

TEST(Words, ManualPageHoldsTheHelp) {
  const ProgramRun page = run_program("help --man");
  EXPECT_EQ(page.status, 0) << page.err;
  std::string text = std::regex_replace(page.out, std::regex("\\\\-"), "-");
  for (const auto& [command, listed] : all_commands()) {
    const auto begin =
        command.empty() ? text.find(".SH OPTIONS") : text.find(".SS \"cardiac " + command + "\"\n");
    ASSERT_NE(begin, std::string::npos) << command;
    const std::string section = text.substr(begin, text.find("\n.S", begin + 1) - begin);
    for (const std::string& option : listed.options) {
      if (!command.empty() && (option == "-h" || option == "--help")) continue;  // said once
      EXPECT_THAT(section, ContainsRegex("[B,]" + option + "[\\\\,]")) << command;
    }
  }
  if (std::system("command -v groff >/dev/null") != 0) return;
  const TemporaryFolder folder;
  const auto file = folder.path / "cardiac.1", complaints = folder.path / "complaints";
  std::ofstream(file) << page.out;
  EXPECT_EQ(std::system(("groff -K utf8 -man -ww -Tutf8 " + file.string() + " 2>" + complaints.string() +
                         " >/dev/null")
                            .c_str()),
            0);
  EXPECT_THAT(whole_file(complaints), IsEmpty());
}

TEST(Words, PathsOfOverridesStartAtTheShellsFolder) {
  const TemporaryFolder folder;
  const std::string protocol = passive_protocol(folder, "file = \"none.vtu\"\nlength_unit = \"mm\"");
  std::filesystem::copy(PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu", folder.path / "lv.vtu");
  const ProgramRun plan =
      run_program("run " + protocol + " --dry-run --set 'mesh.file=\"lv.vtu\"'", in(folder));
  EXPECT_EQ(plan.status, 0) << plan.err;
  EXPECT_THAT(plan.out, HasSubstr("read from lv.vtu\n"));
  const std::string fast =
      " --quiet --set output.mesh_series=false --set output.figures=false --set mesh.file=lv.vtu --out out";
  EXPECT_EQ(run_program("run " + protocol + fast, in(folder)).status, 0);
  // The resolved protocol names it as the protocol file would, from its own folder.
  const auto summary = nlohmann::json::parse(whole_file(folder.path / "out" / "summary.json"));
  EXPECT_EQ(summary.at("protocol").at("mesh").at("file"), "../lv.vtu");
  const ProgramRun none = run_program("run " + protocol + " --dry-run --set mesh.file=rv.vtu", in(folder));
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err,
              AllOf(HasSubstr("no such file rv.vtu"), HasSubstr("in --set: to the current folder")));
}

TEST(Words, TheLastLineTellsTheWholeTime) {
  const TemporaryFolder folder;
  const std::string protocol = passive_protocol(
      folder, "file = \"" PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu\"\nlength_unit = \"mm\"");
  const ProgramRun run = run_program("run " + protocol + " --out out", in(folder));
  EXPECT_EQ(run.status, 0) << run.err;
  std::smatch found;
  ASSERT_TRUE(
      std::regex_search(run.out, found,
                        std::regex("\n[0-9.]+ s of the heart: set-up ([0-9.]+) s, solve ([0-9.]+) s, output "
                                   "([0-9.]+) s, whole ([0-9.]+) s; results in out\n$")))
      << run.out;
  double parts = 0;
  for (int k = 1; k <= 3; ++k) parts += std::stod(found[k]);
  const double whole = std::stod(found[4]);
  // Each number is rounded to a hundredth; what is in no part takes milliseconds, more beside other work.
  EXPECT_GE(whole, parts - 0.02);
  EXPECT_LE(whole, parts + 0.02 + 0.2 * parts);
  EXPECT_GT(std::stod(found[3]), 0);
  // What a run writes is documented.
  const std::string documented = whole_file(PROJECT_DIR "/docs/files.md");
  for (const auto& entry : std::filesystem::directory_iterator(folder.path / "out")) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(".csv") && !file.ends_with(".json")) continue;
    EXPECT_THAT(documented, HasSubstr('`' + file + '`'));
  }
}

TEST(Words, VerificationIsToldOnATerminal) {
  if (std::system("command -v script >/dev/null") != 0)
    GTEST_SKIP() << "no script(1), which makes a terminal";
  const TemporaryFolder folder;
  const std::string protocol = passive_protocol(
      folder, "file = \"" PROJECT_DIR "/meshes/land_ellipsoid_coarse.vtu\"\nlength_unit = \"mm\"");
  const auto shown = folder.path / "shown";
  const std::string run = "'" CARDIAC_PROGRAM "' run " + protocol +
                          " --verify --out out --set output.figures=false --set output.mesh_series=false";
  EXPECT_EQ(
      std::system(
          (in(folder) + "script -qec \"" + run + "\" /dev/null >" + shown.string() + " </dev/null").c_str()),
      0);
  std::smatch took;
  const std::string text = whole_file(shown);
  ASSERT_TRUE(std::regex_search(text, took, std::regex(", verification ([0-9.]+) s"))) << text;
  // The line comes after two seconds, and then with the next step.
  if (std::stod(took[1]) < 4) GTEST_SKIP() << "this machine is too quick for a line of progress";
  EXPECT_THAT(text, ContainsRegex("full order at E[DS]: Newton step [0-9]+, residual [0-9.e-]+ +"
                                  "[0-9]+ %  [0-9]+ s, about [0-9]+ s left"));
}

TEST(Words, AnInstalledProgramBringsItsWordsAndExamples) {
  const TemporaryFolder folder;
  ASSERT_EQ(std::system(("cmake --install \"" CARDIAC_BUILD_DIR "\" --prefix \"" + folder.path.string() +
                         "/usr\" >/dev/null")
                            .c_str()),
            0);
  const auto share = folder.path / "usr" / "share";
  for (const char* file : {"man/man1/cardiac.1", "bash-completion/completions/cardiac", "doc/cardiac/LICENSE",
                           "doc/cardiac/README.md", "cardiac/protocols/healthy_lv.toml"})
    EXPECT_GT(whole_file(share / file).size(), 100U) << file;
  EXPECT_EQ(whole_file(share / "man/man1/cardiac.1"), run_program("help --man").out);
  const auto run = [&](const std::string& arguments) {
    const auto out = folder.path / "out", err = folder.path / "err";
    const int code = std::system(
        (in(folder) + "PATH=usr/bin cardiac " + arguments + " >" + out.string() + " 2>" + err.string())
            .c_str());
    return ProgramRun{WEXITSTATUS(code), whole_file(out), whole_file(err)};
  };
  EXPECT_THAT(run("--help").out, HasSubstr((share / "cardiac").string()));
  const ProgramRun found = run("run protocols/passive_inflation.toml --dry-run");
  EXPECT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.err, HasSubstr("no protocols/passive_inflation.toml here: the example of "));
  EXPECT_THAT(found.out, HasSubstr("read from " + (share / "cardiac/meshes/").string()));
  EXPECT_EQ(run("run protocols/none.toml --dry-run").status, 2);
}

}  // namespace
