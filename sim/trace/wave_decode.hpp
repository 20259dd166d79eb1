// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// From a waveform file to frames, error frames and overload frames with their times.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/types.hpp"
#include "model/bus_decoder.hpp"

namespace vericansim {

struct WaveDecodeOptions {
  std::string signal;             ///< name, or its end; empty: guess
  std::optional<double> bitrate;  ///< bit/s; unset: detect
  int sample_point = 800;         ///< per mille of the bit
};

/// The wire of a waveform.
struct Wave {
  std::string signal;  ///< the one taken, full name
  double bitrate = 0;  ///< bit/s, given or detected
  Time end = 0;        ///< of the waveform, ps
  std::vector<std::pair<Time, Level>> changes;

  /// Where it begins: what is before its first level nobody has recorded. ps
  [[nodiscard]] Time begin() const { return changes.empty() ? 0 : changes.front().first; }
};

/// Reads one signal of a VCD file. Throws InputError if the file, the signal or the bit rate cannot
/// be used.
[[nodiscard]] Wave read_wave(const std::string &path, const WaveDecodeOptions &options);
/// Reads `text` as if it stood in the file `path`.
[[nodiscard]] Wave parse_wave(std::string text, const std::string &path,
                              const WaveDecodeOptions &options);

/// Why a waveform without frames may have none: its edges are those of another bit rate than the
/// one that was given. Empty if they are not.
[[nodiscard]] std::string doubtful_bitrate(const Wave &wave);

/// What of a waveform's beginning is not looked at, though something is on the bus there: a frame
/// is heard behind eleven recessive bits (IN-01). Empty if it begins with as many.
[[nodiscard]] std::string passed_over(const Wave &wave, int sample_point);

struct WaveDecodeResult {
  std::string signal;  ///< the one taken, full name
  double bitrate = 0;  ///< bit/s, given or detected
  Time end = 0;        ///< of the waveform, ps
  std::vector<BusEvent> events;
  /// Where the frame began, or the overload frame, that the end of the waveform cuts, ps.
  std::optional<Time> cut;
};

/// Decodes one signal of a VCD file. Throws InputError if the file, the signal or the bit rate
/// cannot be used.
[[nodiscard]] WaveDecodeResult decode_wave(const std::string &path,
                                           const WaveDecodeOptions &options);
/// Decodes a signal that has been read; `sample_point` in per mille of the bit.
[[nodiscard]] WaveDecodeResult decode_wave(const Wave &wave, int sample_point);

/// "12.000 us frame cut by the end of the waveform".
[[nodiscard]] std::string cut_text(Time start);

}  // namespace vericansim
