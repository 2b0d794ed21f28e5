#include "example_data.hpp"

#include <iostream>

namespace cardiac::app {

namespace fs = std::filesystem;

fs::path example_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const fs::path folder = program.parent_path().parent_path() / "share" / "cardiac";
  return fs::is_directory(folder, error) ? folder : fs::path();
}

fs::path given_or_example(const fs::path& file) {
  std::error_code error;
  if (file.empty() || file.is_absolute() || fs::exists(file, error)) return file;
  const fs::path folder = example_folder();
  if (folder.empty() || !fs::is_regular_file(folder / file, error)) return file;
  std::cerr << "cardiac: no " << file.string() << " here: the example of " << folder.string() << '\n';
  return folder / file;
}

}  // namespace cardiac::app
