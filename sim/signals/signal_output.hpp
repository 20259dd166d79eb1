// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Signals as text, JSON and CSV.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <ostream>
#include <string>

#include "signals/signal_statistics.hpp"
#include "trace/log.hpp"
#include "trace/output_file.hpp"

namespace vericansim {

/// A table of the signals, as lines; says so if there was none.
[[nodiscard]] std::string to_text(const SignalReport &report);
/// {"frames": {"known": 1, "unknown": 0}, "signals": [{"message", "signal", "unit", "count",
/// "first", "last", "min", "max", "mean"}]}; values as in signals_json().
[[nodiscard]] nlohmann::ordered_json to_json(const SignalReport &report);

/// {"EngineSpeed": {"value": 2400.0, "unit": "rpm"}, "Mode": {"value": 2, "text": "Sport"}}.
[[nodiscard]] nlohmann::ordered_json signals_json(const std::vector<SignalValue> &values);

/// A frame's message and signals.
struct DecodedFrame {
  const SignalMessage *message = nullptr;  ///< none: the database does not have it
  std::vector<SignalValue> values;
};
[[nodiscard]] DecodedFrame decode(const Database &database, const Frame &frame);

/// "EngineData(EngineSpeed: 2400 rpm)", "EngineData, remote" or "unknown".
[[nodiscard]] std::string to_text(const DecodedFrame &decoded, const Frame &frame);

/// Adds "message" and "signals" of a frame to its JSON, unless the database does not have it.
void add_signals(nlohmann::ordered_json &json, const DecodedFrame &decoded);

/// Writes a line for each signal of each frame: time in seconds, interface, identifier, message,
/// signal, raw value, value, unit, choice.
class SignalCsv {
 public:
  /// Opens the file and writes the line of names; `start_ns` is added to each time. Throws
  /// OutputError.
  explicit SignalCsv(const std::string &path, std::int64_t start_ns = 0);
  void write(const LogEntry &entry, const DecodedFrame &decoded);
  /// Nothing follows. Throws OutputError.
  void finish();

 private:
  OutputFile file_;
  std::int64_t start_ns_;
};

/// What a database makes of the frames of a bus: the statistics and, if it is wanted, the CSV file.
class SignalRecorder {
 public:
  /// `csv`: its path, empty: none. Throws OutputError if it cannot be written.
  SignalRecorder(std::shared_ptr<const Database> database, const std::string &csv);
  void add(const LogEntry &entry);
  /// Completes the CSV file. Throws OutputError.
  void finish();
  [[nodiscard]] SignalReport report() const { return statistics_.report(); }

 private:
  std::shared_ptr<const Database> database_;
  SignalStatistics statistics_;
  std::unique_ptr<SignalCsv> csv_;
};

}  // namespace vericansim
