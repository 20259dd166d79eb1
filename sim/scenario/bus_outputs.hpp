// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusOutputs: the files that a simulation writes: waveforms and logs.
#pragma once

#include <fstream>
#include <memory>
#include <vector>

#include "bus/bus.hpp"
#include "scenario/bus_monitor.hpp"
#include "scenario/scenario.hpp"
#include "trace/bus_wave.hpp"
#include "trace/candump.hpp"
#include "trace/pcap_file.hpp"

namespace vericansim {

/// Open files of a run. Must outlive the bus.
class BusOutputs {
 public:
  /// Opens what `outputs` names and hangs the waveforms on the bus, which holds all its nodes by
  /// now. `bit_time` is that of the slowest node, ps. Throws InputError if a file cannot be
  /// written.
  BusOutputs(const Outputs &outputs, Bus &bus, Time bit_time);
  /// Appends a frame to the logs.
  void write(const BusFrame &frame);
  /// Completes the waveforms at `time`.
  void finish(Time time);

 private:
  std::ofstream candump_file_;
  std::unique_ptr<CandumpWriter> candump_;
  std::unique_ptr<PcapWriter> pcap_;
  std::vector<std::unique_ptr<BusWave>> waves_;
};

}  // namespace vericansim
