#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/temporary_folder.hpp"
#include "support/whole_file.hpp"

struct ProgramRun {
  int status = -1;
  std::string out, err;
};

/// Runs the program as a child; the arguments, and the commands before it, as a shell reads them.
inline ProgramRun run_program(const std::string& arguments, const std::string& before = "") {
  const TemporaryFolder folder;
  const auto out = folder.path / "out", err = folder.path / "err";
  const int code = std::system((before + "\"" CARDIAC_PROGRAM "\" " + arguments + " >" + out.string() +
                                " 2>" + err.string() + " </dev/null")
                                   .c_str());
  return {WIFEXITED(code) ? WEXITSTATUS(code) : -1, whole_file(out), whole_file(err)};
}
