// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican: what a user does with the simulator without writing C++.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "cli/cli.hpp"
#include "cli/number_check.hpp"
#include "cli/option_message.hpp"
#include "cli/output_files.hpp"
#include "cli/parse_mistake.hpp"
#include "cli/print_error.hpp"
#include "trace/input_error.hpp"
#include "trace/output_error.hpp"
#include "trace/unfinished_files.hpp"
#include "version/version.hpp"

namespace {

using namespace vericansim;

int run_tool(int argc, char **argv) {
  cli::refuse_empty(argc, argv);
  CLI::App app{"VeriCAN: CAN controllers in RTL on a simulated bus"};
  app.require_subcommand(1);
  app.set_version_flag("--version", fmt::format("verican {}", version()));
  app.footer(
      "Exit codes: 0 done, 1 a check failed, 2 bad input, 3 internal error, 4 firmware fault, 5 no "
      "end of the firmware in time. See docs/tool.md.");
  int exit_code = cli::kOk;
  cli::add_run(app, exit_code);
  cli::add_replay(app, exit_code);
  cli::add_paper(app, exit_code);
  cli::add_bittime(app, exit_code);
  cli::add_decode(app, exit_code);
  cli::add_linux(app, exit_code);
  cli::add_firmware(app, exit_code);
  cli::add_report(app, exit_code);
  cli::add_bridge(app, exit_code);
  cli::add_signals(app, exit_code);
  cli::add_convert(app, exit_code);
  cli::add_ids(app, exit_code);
  cli::add_memory(app, exit_code);
  cli::add_timesync(app, exit_code);
  for (CLI::App *command : app.get_subcommands({})) {
    CLI::Option *quiet = command->add_flag_callback(
        "-q,--quiet", cli::be_quiet,
        "Print nothing but errors, and where a bus waits for programs; the exit code "
        "tells the result");
    if (CLI::Option *json = command->get_option_no_throw("--json")) quiet->excludes(json);
  }
  cli::check_numbers(app);
  cli::refuse_unknown_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success &request) {  // --help, --version
    std::ostringstream text;
    app.exit(request, text, text);
    fmt::print("{}", cli::plain_digits(text.str()));
    return cli::kOk;
  } catch (const CLI::ParseError &error) {
    cli::print_error("verican: {}\n", cli::parse_mistake(app, error, argc, argv));
    return cli::kBadInput;
  }
  return exit_code;
}

/// An output could not be written. Who has closed the pipe behind us knows why.
int refuse(const OutputError &error) {
  constexpr int kBrokenPipe = 128 + SIGPIPE;  // what a shell says of a process that it has ended
  if (error.code() == EPIPE) return kBrokenPipe;
  cli::print_error("verican: {}\n", error.what());
  return cli::kBadInput;
}

/// A closed pipe and a file above the limit of its size (`ulimit -f`) are errors of the write, so
/// that files written aside are cleaned up and the reason is told.
void keep_write_errors() {
  struct sigaction action {};
  action.sa_handler = [](int) {};  // SIG_IGN would be inherited by programs that are started
  for (const int signal : {SIGPIPE, SIGXFSZ}) ::sigaction(signal, &action, nullptr);
}

/// A signal that ends the process leaves no file behind whose name nobody knows. What is ignored
/// stays so (nohup), and commands that end cleanly take these signals for themselves.
void clean_up_behind_signals() {
  struct sigaction action {};
  action.sa_handler = [](int signal) {
    remove_unfinished();
    ::raise(signal);
  };
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_DFL) ::sigaction(signal, &action, nullptr);
  }
}

/// Descriptors 0 to 2 that are closed would be given to the files that are opened next, which would
/// take what is printed. They get what fails as they did.
void occupy_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

}  // namespace

int main(int argc, char **argv) {
  occupy_standard_descriptors();
  keep_write_errors();
  clean_up_behind_signals();
  try {
    const int code = run_tool(argc, argv);
    cli::flush_standard_output();
    return code;
  } catch (const OutputError &error) {
    return refuse(error);
  } catch (const InputError &error) {
    cli::print_error("verican: {}\n", error.what());
    return cli::kBadInput;
  } catch (const std::invalid_argument &error) {
    cli::print_error("verican: {}\n", error.what());
    return cli::kBadInput;
  } catch (const std::exception &error) {
    const auto *system = dynamic_cast<const std::system_error *>(&error);
    if (system != nullptr && std::ferror(stdout) != 0)  // fmt::print() failed
      return refuse({"-", "cannot be written to its end", system->code().value()});
    cli::print_error("verican: internal error: {}\n", error.what());
    return cli::kInternal;
  }
}
