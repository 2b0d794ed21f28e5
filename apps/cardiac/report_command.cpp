#include "report_command.hpp"

#include <filesystem>
#include <iostream>
#include <memory>

#include <cardiac/core/csv_reader.hpp>
#include <cardiac/report/figures.hpp>
#include <cardiac/report/page.hpp>
#include <cardiac/report/result_reader.hpp>

namespace cardiac::app {
namespace {

void write_report(const std::filesystem::path& folder) {
  const StoredResult stored = read_result(folder);
  write_figures(stored.result, stored.info, folder);
  const std::filesystem::path wall = folder / "wall.svg";
  write_report_page(stored.result, stored.info, folder, std::filesystem::exists(wall) ? read_text(wall) : "");
  std::cout << (folder / "report.html").string() << "\n";
}

}  // namespace

void add_report_command(CLI::App& app) {
  const auto folder = std::make_shared<std::filesystem::path>();
  CLI::App* command = app.add_subcommand("report", "(Re)write the figures and report.html of a finished run");
  command->add_option("RESULT_DIR", *folder, "Folder that `cardiac run` wrote")->required();
  command->callback([folder] { write_report(*folder); });
}

}  // namespace cardiac::app
