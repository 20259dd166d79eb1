// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican: what a user does with the simulator without writing C++.
#include <fmt/format.h>

#include <exception>
#include <stdexcept>

#include "cli/cli.hpp"
#include "trace/input_error.hpp"
#include "version/version.hpp"

namespace {

using namespace vericansim;

int run_tool(int argc, char **argv) {
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
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success &request) {  // --help, --version
    return app.exit(request);
  } catch (const CLI::ParseError &error) {
    fmt::print(stderr, "verican: {}; try 'verican --help'\n", error.what());
    return cli::kBadInput;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run_tool(argc, argv);
  } catch (const InputError &error) {
    fmt::print(stderr, "verican: {}\n", error.what());
    return cli::kBadInput;
  } catch (const std::invalid_argument &error) {
    fmt::print(stderr, "verican: {}\n", error.what());
    return cli::kBadInput;
  } catch (const std::exception &error) {
    fmt::print(stderr, "verican: internal error: {}\n", error.what());
    return cli::kInternal;
  }
}
