#include <polyaffine/core/atomic_file.hpp>

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <string>
#include <system_error>

#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) {
  return std::generic_category().message(error);
}

constexpr std::string_view kMark = ".tmp-";

fs::path temporary_name(const fs::path& target) {
  return target.parent_path() / ("." + target.stem().string() + std::string(kMark) +
                                 std::to_string(::getpid()) + target.extension().string());
}

// Of the process in a temporary name; 0 in any other.
pid_t writer_of(const std::string& name) {
  const auto mark = name.rfind(kMark);
  if (!name.starts_with('.') || mark == std::string::npos) return 0;
  pid_t pid = 0;
  const char* const begin = name.data() + mark + kMark.size();
  return std::from_chars(begin, name.data() + name.size(), pid).ec == std::errc() ? pid : 0;
}

class RemovedUnlessKept {
 public:
  explicit RemovedUnlessKept(fs::path path) : path_(std::move(path)) {}
  RemovedUnlessKept(const RemovedUnlessKept&) = delete;
  RemovedUnlessKept& operator=(const RemovedUnlessKept&) = delete;
  ~RemovedUnlessKept() {
    std::error_code ignored;
    if (!kept_) fs::remove(path_, ignored);
  }
  void keep() { kept_ = true; }

 private:
  fs::path path_;
  bool kept_ = false;
};

void write_text(const fs::path& path, const fs::path& target, std::string_view text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  if (!file) throw InputError("cannot make " + target.string() + ": " + reason(errno));
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) throw ComputationError("cannot write " + target.string() + " to its end: " + reason(errno));
}

}  // namespace

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (error) throw InputError("cannot make the folder " + folder.string() + ": " + error.message());
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError("cannot write into the folder " + folder.string() + ": " + reason(errno));
}

void remove_abandoned(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const pid_t pid = writer_of(entry.path().filename().string());
    if (pid > 0 && ::kill(pid, 0) != 0 && errno == ESRCH) fs::remove(entry.path(), ignored);
  }
}

void write_atomically(const fs::path& target, const std::function<void(const fs::path&)>& write) {
  const fs::path temporary = temporary_name(target);
  RemovedUnlessKept guard(temporary);
  write(temporary);
  if (!fs::exists(temporary)) throw ComputationError("nothing was written for " + target.string());
  std::error_code error;
  fs::rename(temporary, target, error);
  if (error) throw InputError("cannot put the file " + target.string() + " in place: " + error.message());
  guard.keep();
}

void write_atomically(const fs::path& target, std::string_view text) {
  write_atomically(target, [&](const fs::path& temporary) { write_text(temporary, target, text); });
}

}  // namespace polyaffine
