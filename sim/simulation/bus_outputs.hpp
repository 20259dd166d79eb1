// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusOutputs: the files that a simulation writes: waveforms and logs.
#pragma once

#include <memory>
#include <vector>

#include "bus/bus.hpp"
#include "model/bus_monitor.hpp"
#include "report/report_recorder.hpp"
#include "report/report_writer.hpp"
#include "scenario/scenario.hpp"
#include "signals/signal_output.hpp"
#include "trace/bus_wave.hpp"
#include "trace/candump.hpp"
#include "trace/identifiers.hpp"
#include "trace/pcap_file.hpp"

namespace vericansim {

/// Open files of a run. Must outlive the bus. For a report: construct, record(), begin() when the
/// scenario starts, write() each frame, finish(), write_report().
class BusOutputs {
 public:
  /// Opens what `outputs` names and hangs the waveforms on the bus, which holds all its nodes by
  /// now. `bit_time` is that of the slowest node, ps. Throws OutputError.
  BusOutputs(const Outputs &outputs, Bus &bus, Time bit_time);
  /// Hangs the recorder of a report on the bus, if there is one to write. Puts itself
  /// before `monitor.on_event`; the monitor must be on the bus already.
  void record(Bus &bus, BusMonitor &monitor, const ReportSetup &setup);
  /// The scenario starts at `now`, with its faults on the bus.
  void begin(Time now);
  /// The wire has a new level, for a recording that plays outside the bus.
  void on_level(Time time, Level level);
  /// Appends a frame to the logs.
  void write(const BusFrame &frame, const FrameOrigin &origin = {});
  /// Ends the waveforms at `time`, and the recording of the report; puts all files but the page in
  /// their places, where they are not before. Throws OutputError.
  void finish(Time time);
  /// Writes the page, if there is one to write. Throws OutputError.
  void write_report(ReportExtras extras = {});
  /// What the signals of the databases did; nullptr without databases.
  [[nodiscard]] const SignalRecorder *signals() const { return signals_.get(); }
  /// The identifiers of the frames so far; times count from begin().
  [[nodiscard]] const IdentifierTable &identifiers() const { return identifiers_; }

 private:
  Time start_ = 0;
  IdentifierTable identifiers_;
  std::unique_ptr<OutputFile> ids_file_;
  std::unique_ptr<OutputFile> candump_file_;
  std::unique_ptr<CandumpWriter> candump_;
  std::unique_ptr<PcapWriter> pcap_;
  std::vector<std::unique_ptr<BusWave>> waves_;
  std::unique_ptr<SignalRecorder> signals_;
  std::shared_ptr<const Database> database_;
  std::unique_ptr<ReportWriter> page_;
  std::unique_ptr<ReportRecorder> recorder_;
  std::uint64_t report_frames_;
};

}  // namespace vericansim
