// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// run_python(): see python_helper.hpp. The child's three streams are files in memory: no pipe can
// fill up, and a script may seek in what it reads and writes.
#include "trace/python_helper.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

namespace fs = std::filesystem;

constexpr int kRefused = 2;      // exit code of a script that cannot use its input
constexpr int kNoProgram = 127;  // of posix_spawn's child, where the interpreter is not there

/// An unnamed file in memory.
class MemoryFile {
 public:
  explicit MemoryFile(const char *name) : fd_{::memfd_create(name, MFD_CLOEXEC)} {
    if (fd_ < 0) throw std::runtime_error(std::string("memfd_create: ") + std::strerror(errno));
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile &) = delete;
  MemoryFile &operator=(const MemoryFile &) = delete;

  [[nodiscard]] int fd() const { return fd_; }

  void fill(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::write(fd_, bytes.data(), bytes.size());
      if (count < 0) throw std::runtime_error(std::string("memory file: ") + std::strerror(errno));
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    ::lseek(fd_, 0, SEEK_SET);
  }

  [[nodiscard]] std::string content() const {
    std::string bytes(static_cast<std::size_t>(::lseek(fd_, 0, SEEK_END)), '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t count =
          ::pread(fd_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
      if (count <= 0) throw std::runtime_error("memory file: cannot be read");
      done += static_cast<std::size_t>(count);
    }
    return bytes;
  }

 private:
  int fd_;
};

/// Where `script` lies; empty if nowhere.
fs::path find_script(const std::string &script) {
  std::vector<fs::path> places;
  if (const char *given = std::getenv("VERICAN_PYTHON_DIR")) places.emplace_back(given);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path share = fs::path("share") / "verican" / "python";
  places.push_back(program.parent_path() / share);
  places.push_back(program / share);
  for (const fs::path &place : places)
    if (fs::exists(place / script, error)) return place / script;
  return {};
}

/// Starts the child with the three files as its streams and waits for it; returns its wait status.
int run_child(std::vector<std::string> words, const MemoryFile &in, const MemoryFile &out,
              const MemoryFile &err) {
  std::vector<char *> arguments;
  for (std::string &word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t streams;
  ::posix_spawn_file_actions_init(&streams);
  ::posix_spawn_file_actions_adddup2(&streams, in.fd(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&streams, out.fd(), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&streams, err.fd(), STDERR_FILENO);
  pid_t child = 0;
  const int failure =
      ::posix_spawn(&child, arguments[0], &streams, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&streams);
  if (failure != 0) return kNoProgram << 8;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// Throws InputError if `python`, which somebody has named, runs and is no Python.
void check_interpreter(const std::string &python, const std::string &subject) {
  const MemoryFile in{"in"}, out{"out"}, err{"err"};
  const int status =
      run_child({python, "-c", "import sys; print(sys.version_info[0])"}, in, out, err);
  const bool started = !WIFEXITED(status) || WEXITSTATUS(status) != kNoProgram;
  if (started && (status != 0 || out.content() != "3\n"))
    throw InputError(subject, 0,
                     "needs Python, and " + in_quotes(python) +
                         " of VERICAN_PYTHON is none; allowed: the file of a Python 3");
}

/// The last line that says something.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

}  // namespace

std::string run_python(const PythonCall &call) {
  const fs::path script = find_script(call.script);
  if (script.empty())
    throw InputError(call.subject, 0,
                     "needs " + call.script +
                         " of share/verican/python, which is not beside this program; allowed: "
                         "VERICAN_PYTHON_DIR=FOLDER names it");
  const char *given = std::getenv("VERICAN_PYTHON");
  const std::string python = given != nullptr ? given : "/usr/bin/python3";
  if (given != nullptr) check_interpreter(python, call.subject);
  const MemoryFile in{"in"}, out{"out"}, err{"err"};
  in.fill(call.input);
  // -B: no __pycache__ in an installed tree.
  std::vector<std::string> words{python, "-B", script.string()};
  words.insert(words.end(), call.arguments.begin(), call.arguments.end());
  const int status = run_child(std::move(words), in, out, err);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return out.content();
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoProgram)
    throw InputError(call.subject, 0,
                     "needs Python, and " + in_quotes(python) +
                         " cannot be started; allowed: VERICAN_PYTHON=FILE names another");
  const std::string said = last_line(err.content());
  if (WIFEXITED(status) && WEXITSTATUS(status) == kRefused)
    throw InputError(call.subject, 0, said.empty() ? "refused by " + call.script : said);
  throw std::runtime_error(call.script + ": " + (said.empty() ? "it was stopped" : said));
}

}  // namespace vericansim
