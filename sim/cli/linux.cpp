// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican linux: runs a user-mode Linux whose CAN controllers are Verilated cores.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include "cli/cli.hpp"
#include "cli/output_files.hpp"
#include "cli/print_error.hpp"
#include "cli/rate_option.hpp"
#include "linux/guest_server.hpp"
#include "simulation/stop_request.hpp"
#include "trace/input_error.hpp"
#include "trace/temporary_folder.hpp"

namespace vericansim::cli {
namespace {

struct LinuxOptions {
  std::string kernel;
  std::string dtb;
  std::string init;
  std::string preload;
  BoardConfig board;
  std::string memory = "64M";
  unsigned timeout = 600;
  std::vector<std::string> arguments;
};

/// A directory for the sockets that goes with its contents; short, since paths of sockets are.
class SocketDirectory {
 public:
  SocketDirectory() {
    std::string path = temporary_folder() + "/verican-XXXXXX";
    if (::mkdtemp(path.data()) == nullptr)
      throw InputError("TMPDIR", 0, path + " cannot be made: " + std::strerror(errno));
    path_ = path;
  }
  ~SocketDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  SocketDirectory(const SocketDirectory &) = delete;
  SocketDirectory &operator=(const SocketDirectory &) = delete;
  [[nodiscard]] const std::string &path() const { return path_; }

 private:
  std::string path_;
};

/// The guest kernel as a process of its own, in a process group of its own: it has helpers.
class GuestProcess {
 public:
  /// Throws InputError if words[0] is no program.
  GuestProcess(const std::vector<std::string> &words, const std::string &preload) {
    std::vector<char *> argv;
    for (const std::string &word : words) argv.push_back(const_cast<char *>(word.c_str()));
    argv.push_back(nullptr);
    int failure[2];  // the errno of execv(); closed without one when the kernel runs
    if (::pipe2(failure, O_CLOEXEC) != 0 || (pid_ = ::fork()) < 0)
      throw std::runtime_error("the guest kernel cannot be started");
    if (pid_ == 0) {
      ::setpgid(0, 0);
      if (!preload.empty()) ::setenv("LD_PRELOAD", preload.c_str(), 1);
      ::execv(argv[0], argv.data());
      const int code = errno;
      [[maybe_unused]] const auto ignored = ::write(failure[1], &code, sizeof code);
      ::_exit(127);
    }
    ::setpgid(pid_, pid_);  // whoever of the two is first
    ::close(failure[1]);
    int code = 0;
    while (::read(failure[0], &code, sizeof code) < 0 && errno == EINTR) {
    }
    ::close(failure[0]);
    if (code == 0) return;
    wait();
    throw InputError("--kernel", 0, "cannot run " + words[0] + ": " + std::strerror(code));
  }
  ~GuestProcess() {
    if (!over()) ::kill(-pid_, SIGKILL);
    wait();
  }
  GuestProcess(const GuestProcess &) = delete;
  GuestProcess &operator=(const GuestProcess &) = delete;

  [[nodiscard]] bool over() {
    if (!over_) over_ = ::waitpid(pid_, &status_, WNOHANG) == pid_;
    return over_;
  }
  /// Waits for its end and returns its exit code, or 128 + signal.
  int wait() {
    while (!over_) over_ = ::waitpid(pid_, &status_, 0) == pid_ || errno != EINTR;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  }

 private:
  pid_t pid_ = -1;
  int status_ = 0;
  bool over_ = false;
};

void must_exist(const char *option, const std::string &path) {
  if (::access(path.c_str(), R_OK) != 0) throw InputError(option, 0, "cannot read " + path);
  if (std::error_code none; std::filesystem::is_directory(path, none))
    throw InputError(option, 0, path + " is a directory; allowed: a file");
}

/// The guest's logs are made in it while the guest runs, too late to say that they cannot be.
void must_take_files(const char *option, const std::string &directory) {
  if (std::error_code none; !std::filesystem::is_directory(directory, none))
    throw InputError(option, 0, directory + " is no directory");
  if (::access(directory.c_str(), W_OK | X_OK) != 0)
    throw InputError(option, 0, directory + " cannot be written: " + std::strerror(errno));
}

/// Throws InputError for what cannot be run so.
void check(const LinuxOptions &options) {
  must_exist("--kernel", options.kernel);
  if (::access(options.kernel.c_str(), X_OK) != 0)
    throw InputError("--kernel", 0, options.kernel + " is no program: it may not be executed");
  must_exist("--dtb", options.dtb);
  must_exist("--init", options.init);
  if (!options.preload.empty()) must_exist("--preload", options.preload);
  if (!options.board.directory.empty()) must_take_files("--dir", options.board.directory);
  const std::size_t errors = options.board.clock_ppm.size();
  if (errors > options.board.controllers)
    throw InputError("--clock-ppm", 0,
                     fmt::format("{} errors of {} clocks; allowed: as many as --controllers, or "
                                 "fewer",
                                 errors, options.board.controllers));
}

std::vector<std::string> kernel_command(const LinuxOptions &options, const std::string &sockets) {
  std::vector<std::string> words{options.kernel,
                                 "mem=" + options.memory,
                                 "rootfstype=hostfs",
                                 "rootflags=/",
                                 "ro",
                                 "init=" + options.init,
                                 "dtb=" + options.dtb,
                                 "con=null",
                                 "con0=null,fd:1",
                                 "quiet",
                                 "uml_dir=" + sockets,
                                 "time-travel=ext:" + sockets + "/time",
                                 "VERICAN_SOCKETS=" + sockets,
                                 "VERICAN_DIR=" + options.board.directory};
  words.insert(words.end(), options.arguments.begin(), options.arguments.end());
  return words;
}

int run(const LinuxOptions &options) {
  check(options);
  const StopSignals signals;
  Board board{options.board};
  const SocketDirectory sockets;
  GuestServer server{board, sockets.path()};
  GuestProcess guest{kernel_command(options, sockets.path()), options.preload};
  using Wall = std::chrono::steady_clock;
  const auto start = Wall::now();
  bool late = false;
  server.serve([&] {
    late = Wall::now() - start > std::chrono::seconds{options.timeout};
    return late || guest.over();
  });
  const std::chrono::duration<double> wall = Wall::now() - start;
  board.close_logs();
  if (!is_quiet())
    print_error(
        "verican linux: {:.3f} s of guest time ({:.3f} s asleep), {} accesses, {} interrupts, "
        "{:.1f} s\n",
        static_cast<double>(board.now()) / 1e9, static_cast<double>(board.asleep()) / 1e9,
        server.accesses(), server.interrupts(), wall.count());
  if (stop_requested()) {
    print_error("verican linux: interrupted; the guest is ended\n");
    return exit_code_after(kFailed);
  }
  if (late) {
    print_error("verican linux: the guest did not end within {} s\n", options.timeout);
    return kFailed;
  }
  const int code = guest.wait();
  if (!server.connected() && code == 0) {
    print_error("verican linux: {} is no user-mode Linux with time-travel support\n",
                options.kernel);
    return kFailed;
  }
  if (code != 0) print_error("verican linux: the guest kernel ended with code {}\n", code);
  return code == 0 ? kOk : kFailed;
}

}  // namespace

void add_linux(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<LinuxOptions>();
  CLI::App *command =
      app.add_subcommand("linux", "Run a user-mode Linux on Verilated cores (docs/software.md)");
  command->add_option("--kernel", options->kernel, "User-mode Linux with the glue")->required();
  command->add_option("--dtb", options->dtb, "Device tree with the controllers")->required();
  command->add_option("--init", options->init, "First program of the guest")->required();
  command->add_option("--preload", options->preload, "Library to preload into the guest kernel");
  command->add_option("--controllers", options->board.controllers, "Cores on the bus (2)")
      ->check(CLI::Range(1, 8));
  command
      ->add_option("--clock", options->board.clock_hz, "Clock of the cores, Hz; as in the DTB (8M)")
      ->transform(clock_units());
  command->add_option("--clock-ppm", options->board.clock_ppm, "Error of each core's clock, ppm")
      ->delimiter(',')
      ->check(CLI::Range(-100'000.0, 100'000.0));
  CLI::Option *const time_unit = command->add_flag("--time-unit", options->board.time_unit,
                                                   "Cores with the time unit, in windows of 8 KiB");
  command
      ->add_flag("--lean", options->board.lean,
                 "Cores without the features that the driver can do without")
      ->excludes(time_unit);
  CLI::Option *const directory = command->add_option("--dir", options->board.directory,
                                                     "Directory for logs, also the guest's");
  command->add_flag("--access-logs", options->board.access_logs, "Log each register access")
      ->needs(directory);
  command->add_option("--memory", options->memory, "Memory of the guest (64M)");
  command->add_option("--timeout", options->timeout, "Longest run, seconds of real time (600)");
  command->add_option("arguments", options->arguments, "More words for the guest's command line");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vericansim::cli
