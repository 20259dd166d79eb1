// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Waveform to frames: signal, bit rate, bus decoder.
#include "trace/wave_decode.hpp"

#include <cmath>
#include <utility>

#include "trace/bitrate.hpp"
#include "trace/input_error.hpp"
#include "trace/vcd_file.hpp"

namespace vericansim {

Wave read_wave(const std::string &path, const WaveDecodeOptions &options) {
  const VcdFile file{path};
  const VcdSignal &signal = options.signal.empty() ? file.guess_bus() : file.find(options.signal);
  Wave wave;
  wave.signal = signal.name;
  wave.end =
      file.read(signal, [&](Time time, Level level) { wave.changes.emplace_back(time, level); });
  if (options.bitrate) {
    wave.bitrate = *options.bitrate;
    return wave;
  }
  std::vector<Time> edges;
  for (const auto &change : wave.changes) edges.push_back(change.first);
  const auto bitrate = detect_bitrate(edges);
  if (!bitrate)
    throw InputError(path, 0,
                     "the bit rate of signal " + quoted(signal.name) + " cannot be told from its " +
                         std::to_string(edges.size()) + " edges; give it with --bitrate");
  wave.bitrate = *bitrate;
  return wave;
}

WaveDecodeResult decode_wave(const std::string &path, const WaveDecodeOptions &options) {
  const Wave wave = read_wave(path, options);
  WaveDecodeResult result{wave.signal, wave.bitrate, wave.end, {}};
  DecoderConfig config;
  config.bit_time = static_cast<Time>(std::llround(1e12 / result.bitrate));
  config.sample_point = options.sample_point;
  BusDecoder decoder{config, [&](const BusEvent &event) { result.events.push_back(event); }};
  for (const auto &[time, level] : wave.changes) decoder.on_level(time, level);
  // The last frame may end with the file: grant it the recessive bits that end it.
  decoder.finish(result.end + 12 * config.bit_time);
  return result;
}

}  // namespace vericansim
