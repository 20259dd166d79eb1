// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A report of a recorded waveform: a listen-only controller hears it.
#pragma once

#include <functional>
#include <optional>

#include "model/bus_monitor.hpp"
#include "scenario/scenario.hpp"
#include "trace/wave_decode.hpp"

namespace vericansim {

/// What a listener has heard.
struct WaveReport {
  std::uint64_t frames = 0;  ///< acknowledged
  bool interrupted = false;  ///< the user has ended it before the end of the recording
  std::uint64_t unacknowledged = 0, error_frames = 0, overload_frames = 0;
  /// Where the frame began that the end of the waveform cuts, ps.
  std::optional<Time> cut = {};
};

/// Plays `wave` to one listen-only core and writes `outputs.report`. As any node, it joins the bus
/// after eleven recessive bits (IN-01). `progress` (0..1) may be empty. Throws InputError if the
/// page cannot be written.
[[nodiscard]] WaveReport report_wave(const Wave &wave, const std::string &title,
                                     const Outputs &outputs,
                                     const std::function<void(double)> &progress = {});

}  // namespace vericansim
