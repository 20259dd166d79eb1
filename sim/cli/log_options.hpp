// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Options that commands which read recordings share: the part of it, and the table of identifiers.
#pragma once

#include <CLI/CLI.hpp>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "trace/identifiers.hpp"
#include "trace/log.hpp"
#include "trace/log_filter.hpp"

namespace vericansim::cli {

/// What of a recording is wanted, as it was typed.
struct LogSelection {
  std::string interface;
  std::vector<std::string> filters;  ///< candump's ID:MASK and ID~MASK
  std::string from, to;
};

/// Adds --interface, --filter, --from and --to; `several` as for read_selected().
void add_selection(CLI::App &command, LogSelection &selection, bool several = false);

/// Throws InputError if more nodes (--senders) are to share a recording than there are (--nodes).
void check_senders(unsigned senders, unsigned nodes);

/// Two neighbours in a recording, the second of which has the earlier time.
struct StepBack {
  std::size_t frame = 0;  ///< the second, counted from 1
  Time by = 0;            ///< above 0
};

/// {"frame": 2, "by_ps": 500000000000}, or null.
[[nodiscard]] nlohmann::ordered_json to_json(const std::optional<StepBack> &step);

/// A recording, or the wanted part of it.
struct SelectedLog {
  CanLog log;
  std::map<std::string, std::size_t> interfaces;  ///< of the part
  std::size_t whole = 0;                          ///< frames of the recording
  std::optional<StepBack> step_back;              ///< the first, in the whole recording
  /// "all interfaces as one bus: can0 (2 frames), can1 (1 frame)"; empty with one.
  [[nodiscard]] std::string note() const;
  /// Why the part holds no frame.
  [[nodiscard]] std::string why_empty() const;
};

/// read_log() that tells its warnings, and where times first go back, on standard error.
[[nodiscard]] CanLog read_and_warn(const std::string &path);

/// Reads `path`. Unless `several`, a recording of several interfaces needs a choice. Times that go
/// back are told on standard error. Throws InputError.
[[nodiscard]] SelectedLog read_selected(const std::string &path, const LogSelection &selection,
                                        bool several);

/// Where the table of identifiers goes.
struct IdsOutput {
  bool text = false;
  std::string csv;  ///< file name, "-" for stdout; empty: none
  [[nodiscard]] bool wanted() const { return text || !csv.empty(); }
};

/// Adds --ids and --ids-csv.
void add_ids_options(CLI::App &command, IdsOutput &output);

/// The table of a recording.
[[nodiscard]] IdentifierTable identifiers_of(const CanLog &log);

/// Writes the CSV, if one is wanted. Throws OutputError.
void write_ids_csv(const IdentifierTable &table, const IdsOutput &output);

}  // namespace vericansim::cli
