// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReportWriter: one self-contained HTML file from recorded columns (docs/report-format.md).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/report_recorder.hpp"
#include "results/report.hpp"
#include "trace/output_file.hpp"

namespace vericansim {

/// What a message's report does not say.
struct ReportMessage {
  NodeId node = 0;
  Frame frame;
  Time period = 0;  ///< ps, 0: once
};

/// A statement of the paper, for its page.
struct ReportStatement {
  std::string figure, reported, seen;
  bool ok = true;
  std::optional<Time> time;  ///< of the bus, ps: the moment that shows it
};

/// What the page shows besides the recording; all of it may be missing.
struct ReportExtras {
  const RunReport *run = nullptr;       ///< messages, checks, what the software has received
  std::vector<ReportMessage> messages;  ///< one for each message of `run`
  std::vector<ReportStatement> statements;
  std::optional<std::pair<Time, Time>> view;  ///< of the bus, ps: what the page shows first
  const Database *database = nullptr;         ///< of signals
  const RemoteColumns *remote = nullptr;      ///< of remote nodes, if there are any
  Time zero = 0;  ///< of the bus, ps: time 0 of the waveform, and 1 s of logs
};

/// Opens the file at once, so that a path that cannot be written is refused before a simulation
/// runs.
class ReportWriter {
 public:
  /// Throws OutputError if `path` cannot be written, InputError if the library was built without
  /// the page.
  explicit ReportWriter(std::string path);
  /// Writes the page of a finished recording. Throws OutputError.
  void write(const ReportRecorder &recorder, const ReportExtras &extras = {});

 private:
  OutputFile file_;
};

}  // namespace vericansim
