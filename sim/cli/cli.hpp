// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the subcommands of `verican` share: exit codes, output, and how each of them joins the tool.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <string>

#include "bus/types.hpp"
#include "model/frame.hpp"
#include "scenario/scenario.hpp"

namespace vericansim::cli {

/// Exit codes of the tool, documented in docs/tool.md.
enum ExitCode : int {
  kOk = 0,  ///< done, and everything that was checked is as expected
  kFailed =
      1,  ///< done, but a check failed: an expectation, a replayed frame, a result of the paper
  kBadInput =
      2,  ///< a file, an option or a value cannot be used; one line on stderr says which and why
  kInternal = 3,  ///< a mistake in the tool itself
  kFault = 4,     ///< firmware: a CPU was stopped by a fault
  kLimit = 5,     ///< firmware: no end within the simulated time allowed
};

/// Each adds its subcommand; the callback stores the exit code.
void add_run(CLI::App &app, int &exit_code);
void add_replay(CLI::App &app, int &exit_code);
void add_decode(CLI::App &app, int &exit_code);
void add_bittime(CLI::App &app, int &exit_code);
void add_paper(CLI::App &app, int &exit_code);
void add_linux(CLI::App &app, int &exit_code);
void add_firmware(CLI::App &app, int &exit_code);
void add_report(CLI::App &app, int &exit_code);
void add_bridge(CLI::App &app, int &exit_code);
void add_signals(CLI::App &app, int &exit_code);
void add_convert(CLI::App &app, int &exit_code);
void add_ids(CLI::App &app, int &exit_code);
void add_memory(CLI::App &app, int &exit_code);
void add_timesync(CLI::App &app, int &exit_code);

/// The files of an Outputs.
inline constexpr std::string Outputs::*kOutputPaths[] = {
    &Outputs::vcd,    &Outputs::fst,         &Outputs::candump, &Outputs::pcap,
    &Outputs::report, &Outputs::signals_csv, &Outputs::ids_csv};

/// Adds an option for each of them; `report_names` are those of the page.
void add_output_options(CLI::App &command, Outputs &outputs,
                        const std::string &report_names = "--report,--report-page");
/// Adds --report-frames.
void add_report_frames_option(CLI::App &command, Outputs &outputs);
/// Throws InputError if a length is given for a page that is not written.
void require_page(const Outputs &outputs);
/// Throws InputError if the command line names databases (`files`) and nothing shows signals.
/// `json`: what is printed does.
void require_signals(const Outputs &outputs, const std::vector<std::string> &files, bool json);
/// What is given on the command line takes the place of what a scenario says; databases are added
/// and read. `json` as for require_signals(). Throws InputError.
void override_outputs(Outputs &target, const Outputs &given, bool json);
/// Adds --dbc. Refused, before anything is read: standard input as two of the files that the
/// command reads, of which it would be only one.
void add_database_option(CLI::App &command, std::vector<std::string> &files);
/// Reads the databases that the command line names. Throws InputError, also if there is none and
/// something needs one.
void load_databases(Outputs &outputs, const std::vector<std::string> &files);
/// Names for one of several runs: "bus.vcd" becomes "bus-500k.vcd".
[[nodiscard]] Outputs outputs_for(const Outputs &outputs, double bitrate);

/// A check of CLI11 for counts: what is wrong with `value`, or nothing.
[[nodiscard]] std::string at_least_one(const std::string &value);

using Json = nlohmann::ordered_json;

/// The exit code of work that has seen to its end: `code`, or that of the signal that ended it
/// early (128 + its number, as a shell says it).
[[nodiscard]] int exit_code_after(int code);

/// A frame as an object: id, extended, remote, dlc, data (hexadecimal).
[[nodiscard]] Json to_json(const Frame &frame);

/// "12.345 ms" with the unit that suits.
[[nodiscard]] std::string time_text(Time time);

/// The value of an option such as "50 ms"; throws InputError that names the option.
[[nodiscard]] Time time_option(const std::string &option, const std::string &text);
/// The same for a time within limits.
[[nodiscard]] Time time_option(const std::string &option, const std::string &text, Time least,
                               Time most);

/// Prints indented JSON and a line end. Bytes of names that are no UTF-8 become U+FFFD.
void print_json(const Json &json);

/// A progress bar on stderr, only if that is a terminal; costs one comparison a call otherwise.
class Progress {
 public:
  explicit Progress(std::string title);
  ~Progress();
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;
  /// `part` of the work is done, 0..1.
  void show(double part);

 private:
  std::string title_;
  bool terminal_;
  int shown_ = -1;
};

}  // namespace vericansim::cli
