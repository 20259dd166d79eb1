// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Waveform to frames: signal, bit rate, bus decoder.
#include "trace/wave_decode.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "bus/range.hpp"
#include "trace/bitrate.hpp"
#include "trace/input_error.hpp"
#include "trace/log.hpp"
#include "trace/vcd_file.hpp"

namespace vericansim {
namespace {

// Bit rates of classical CAN, as --bitrate takes them.
constexpr double kSlowest = 1e3, kFastest = 1e6;

std::optional<double> detected_bitrate(const Wave &wave) {
  std::vector<Time> edges;
  for (const auto &change : wave.changes) edges.push_back(change.first);
  return detect_bitrate(edges);
}

DecoderConfig config_of(const Wave &wave, int sample_point) {
  DecoderConfig config;
  config.bit_time = bit_time_of(wave.bitrate);
  config.sample_point = sample_point;
  return config;
}

}  // namespace

Wave read_wave(const std::string &path, const WaveDecodeOptions &options) {
  return parse_wave(read_text_file(path), path, options);
}

Wave parse_wave(std::string text, const std::string &path, const WaveDecodeOptions &options) {
  const VcdFile file{path, std::move(text)};
  const VcdSignal &signal = options.signal.empty() ? file.guess_bus() : file.find(options.signal);
  Wave wave;
  wave.signal = signal.name;
  wave.end =
      file.read(signal, [&](Time time, Level level) { wave.changes.emplace_back(time, level); });
  if (options.bitrate) {
    wave.bitrate = *options.bitrate;
    return wave;
  }
  const auto bitrate = detected_bitrate(wave);
  if (!bitrate)
    throw InputError(path, 0,
                     "the bit rate of signal " + in_quotes(signal.name) +
                         " cannot be told from its " + std::to_string(wave.changes.size()) +
                         " edges; give it with --bitrate");
  if (*bitrate < kSlowest || *bitrate > kFastest)
    throw InputError(
        path, 0,
        fmt::format("signal {} has edges as at {:.{}f} bit/s; allowed: {:.0f} to {:.0f}; "
                    "give the bit rate with --bitrate",
                    in_quotes(signal.name), *bitrate, *bitrate < 10 ? 3 : 0, kSlowest, kFastest));
  wave.bitrate = *bitrate;
  return wave;
}

std::string doubtful_bitrate(const Wave &wave) {
  constexpr double kTolerance = 0.05;  // more than clocks are off by
  const auto seen = detected_bitrate(wave);
  if (!seen || std::abs(*seen / wave.bitrate - 1) < kTolerance) return "";
  return fmt::format("signal {} has edges as at {:.0f} bit/s, and was read at {:.0f}",
                     in_quotes(wave.signal), *seen, wave.bitrate);
}

std::string passed_over(const Wave &wave, int sample_point) {
  BusDecoder decoder{config_of(wave, sample_point), [](const BusEvent &) {}};
  bool busy = false;
  const auto rests = [&](Time now) {
    decoder.finish(now);
    return decoder.at_rest_since();
  };
  std::optional<Time> rest;
  for (const auto &[time, level] : wave.changes) {
    if (rest = rests(time); rest) break;
    decoder.on_level(time, level);
    busy = busy || level == Level::kDominant;
  }
  if (!rest) rest = rests(wave.end);
  if (!busy) return "";
  if (!rest) return "nowhere in it are eleven recessive bits, behind which alone a frame can begin";
  return fmt::format(
      "what is on the bus in its first {:.3f} us is passed over: eleven recessive bits come first",
      static_cast<double>(*rest - wave.begin()) / kMicrosecond);
}

WaveDecodeResult decode_wave(const std::string &path, const WaveDecodeOptions &options) {
  return decode_wave(read_wave(path, options), options.sample_point);
}

WaveDecodeResult decode_wave(const Wave &wave, int sample_point) {
  WaveDecodeResult result{wave.signal, wave.bitrate, wave.end, {}, {}};
  const DecoderConfig config = config_of(wave, sample_point);
  BusDecoder decoder{config, [&](const BusEvent &event) { result.events.push_back(event); }};
  for (const auto &[time, level] : wave.changes) decoder.on_level(time, level);
  decoder.finish(result.end);
  // The last frame may end with the file: grant it the recessive bits that end it, but not those of
  // which one would be its acknowledge.
  if (!decoder.before_ack_delimiter()) decoder.finish(result.end + 12 * config.bit_time);
  result.cut = decoder.under_way();
  return result;
}

std::string cut_text(Time start) {
  return fmt::format("{:.3f} us frame cut by the end of the waveform",
                     static_cast<double>(start) / kMicrosecond);
}

}  // namespace vericansim
