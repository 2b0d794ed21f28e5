#include "polyaffine/vtk/child_process.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <polyaffine/core/error.hpp>

namespace polyaffine {
namespace {

constexpr char kMesh = 'm', kWrongInput = 'w';
constexpr unsigned kLongestWait_s = 600;

class Packer {
 public:
  explicit Packer(std::string& out) : out_(out) {}
  void number(Eigen::Index n) { raw(&n, sizeof n); }
  void text(const std::string& s) {
    number(static_cast<Eigen::Index>(s.size()));
    raw(s.data(), s.size());
  }
  template <class Dense>
  void matrix(const Dense& m) {
    number(m.rows());
    number(m.cols());
    raw(m.data(), sizeof(typename Dense::Scalar) * static_cast<std::size_t>(m.size()));
  }
  void fields(const std::map<std::string, Matrix>& all) {
    number(static_cast<Eigen::Index>(all.size()));
    for (const auto& [name, values] : all) {
      text(name);
      matrix(values);
    }
  }

 private:
  void raw(const void* from, std::size_t bytes) { out_.append(static_cast<const char*>(from), bytes); }
  std::string& out_;
};

class Unpacker {
 public:
  Unpacker(const std::string& from, std::size_t at) : from_(from), at_(at) {}
  Eigen::Index number() {
    Eigen::Index n = 0;
    raw(&n, sizeof n);
    return n;
  }
  std::string text() {
    std::string s(static_cast<std::size_t>(number()), '\0');
    raw(s.data(), s.size());
    return s;
  }
  template <class Dense>
  void matrix(Dense& m) {
    const Eigen::Index rows = number(), cols = number();
    m.resize(rows, cols);
    raw(m.data(), sizeof(typename Dense::Scalar) * static_cast<std::size_t>(m.size()));
  }
  void fields(std::map<std::string, Matrix>& all) {
    for (Eigen::Index left = number(); left > 0; --left) {
      const std::string name = text();
      matrix(all[name]);
    }
  }

 private:
  void raw(void* to, std::size_t bytes) {
    if (bytes > 0) std::memcpy(to, from_.data() + at_, bytes);
    at_ += bytes;
  }
  const std::string& from_;
  std::size_t at_;
};

// As VTK files fill them: neither names of surfaces nor source.
std::string packed(const MeshData& data) {
  std::string out(1, kMesh);
  Packer to(out);
  to.matrix(data.points);
  to.matrix(data.tets);
  to.matrix(data.triangles);
  for (const auto* fields : {&data.point_fields, &data.tet_fields, &data.triangle_fields}) to.fields(*fields);
  to.number(static_cast<Eigen::Index>(data.notes.size()));
  for (const std::string& note : data.notes) to.text(note);
  return out;
}

MeshData unpacked(const std::string& bytes) {
  MeshData out;
  Unpacker from(bytes, 1);
  from.matrix(out.points);
  from.matrix(out.tets);
  from.matrix(out.triangles);
  for (auto* fields : {&out.point_fields, &out.tet_fields, &out.triangle_fields}) from.fields(*fields);
  for (Eigen::Index left = from.number(); left > 0; --left) out.notes.push_back(from.text());
  return out;
}

void limit(decltype(RLIMIT_AS) what, rlim_t most) {
  rlimit both{};
  getrlimit(what, &both);
  both.rlim_cur = std::min(both.rlim_cur, most);
  setrlimit(what, &both);
}

void set_limits(rlim_t file_bytes) {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  limit(RLIMIT_AS,
        pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{256} << 20U) + 100 * file_bytes);
  limit(RLIMIT_CPU, 4 + (file_bytes >> 20U));
  limit(RLIMIT_CORE, 0);
  for (const int signal : {SIGALRM, SIGXCPU, SIGSEGV, SIGABRT, SIGBUS}) std::signal(signal, SIG_DFL);
  alarm(kLongestWait_s);
  if (const int nothing = open("/dev/null", O_WRONLY); nothing >= 0) dup2(nothing, STDERR_FILENO);
}

[[noreturn]] void answer(int pipe, const std::function<MeshData()>& read) {
  std::string bytes;
  try {
    bytes = packed(read());
  } catch (const InputError& error) {
    bytes = kWrongInput + std::string(error.what());
  } catch (const std::exception&) {
    std::abort();
  }
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t n = write(pipe, bytes.data() + sent, bytes.size() - sent);
    if (n < 0 && errno != EINTR) _exit(1);
    if (n > 0) sent += static_cast<std::size_t>(n);
  }
  _exit(0);
}

std::string received(int pipe) {
  std::string out;
  std::array<char, 1 << 16> part;
  for (;;) {
    const ssize_t n = ::read(pipe, part.data(), part.size());
    if (n > 0)
      out.append(part.data(), static_cast<std::size_t>(n));
    else if (n == 0 || errno != EINTR)
      return out;
  }
}

}  // namespace

MeshData read_in_child(const std::filesystem::path& file, const std::function<MeshData()>& read) {
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw ComputationError("cannot open a pipe to read " + file.string());
  const pid_t child = fork();
  if (child < 0) throw ComputationError("cannot start a process to read " + file.string());
  if (child == 0) {
    close(ends[0]);
    set_limits(none ? 0 : size);
    answer(ends[1], read);
  }
  close(ends[1]);
  const std::string bytes = received(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || bytes.empty())
    throw InputError(file.string() + ": found a damaged file (it breaks off VTK's reader" +
                     (WIFSIGNALED(status) ? std::string(": ") + strsignal(WTERMSIG(status)) : "") +
                     "), expected a VTK file");
  if (bytes[0] == kWrongInput) throw InputError(bytes.substr(1));
  MeshData out = unpacked(bytes);
  out.source = file;
  return out;
}

}  // namespace polyaffine
