// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Targets: waveforms. Any text as VCD; and frames as VCD, which must come out as they went in.
#include <vector>

#include "fuzz/target.hpp"
#include "model/frame_codec.hpp"
#include "trace/input_error.hpp"
#include "trace/vcd_file.hpp"
#include "trace/wave_decode.hpp"

namespace vericansim::fuzz {
namespace {

const std::string kFile = "input.vcd";

void require_in_order(const WaveDecodeResult &result) {
  Time last = 0;
  for (const BusEvent &event : result.events) {
    require(event.start <= event.end && event.end >= last, "events in the order of time");
    last = event.end;
    if (event.kind == BusEventKind::kFrame) require_valid(event.frame);
  }
}

Frame take_frame(Reader &input) {
  Frame frame;
  const std::uint8_t kind = input.byte();
  frame.extended = (kind & 0x80) != 0;
  frame.remote = (kind & 0x40) != 0;
  frame.dlc = kind & 0xF;
  frame.id = static_cast<std::uint32_t>(input.number(frame.extended ? 4 : 2)) &
             (frame.extended ? 0x1FFFFFFF : 0x7FF);
  for (std::size_t i = 0; i < frame.payload_size(); ++i) frame.data[i] = input.byte();
  return frame;
}

/// A waveform, bit by bit.
class Waveform {
 public:
  explicit Waveform(Time bit_time) : bit_time_{bit_time} {}
  void put(Level level) {
    if (level != last_)
      text_ += "#" + std::to_string(now_) + (level == Level::kDominant ? "\n0!\n" : "\n1!\n");
    last_ = level;
    now_ += bit_time_;
  }
  void rest(unsigned bits) {
    for (unsigned i = 0; i < bits; ++i) put(Level::kRecessive);
  }
  [[nodiscard]] std::string finish() { return text_ + "#" + std::to_string(now_) + "\n"; }

 private:
  Time bit_time_;
  Time now_ = 0;
  Level last_ = Level::kRecessive;
  std::string text_ =
      "$timescale 1 ps $end\n$var wire 1 ! can $end\n$enddefinitions $end\n#0\n1!\n";
};

}  // namespace

void fuzz_vcd(Bytes input) {
  const std::string text{text_of(input)};
  for (const bool named : {false, true}) {
    try {
      WaveDecodeOptions options;
      if (named) options.bitrate = 500e3;
      const Wave wave = parse_wave(text, kFile, options);
      Time last = 0;
      for (const auto &[time, level] : wave.changes) {
        require(time >= last && time <= wave.end, "changes in the order of time");
        last = time;
      }
      require_in_order(decode_wave(wave, options.sample_point));
    } catch (const InputError &) {
    }
  }
  try {
    const VcdFile file{kFile, text};
    for (const VcdSignal &signal : file.signals()) static_cast<void>(file.find(signal.name));
  } catch (const InputError &) {
  }
}

// Bit rate, sample point, then frames and the rest between them.
void fuzz_wave(Bytes bytes) {
  Reader input{bytes};
  WaveDecodeOptions options;
  constexpr double kRates[] = {1e6, 500e3, 250e3, 125e3, 10e3, 1e3, 800e3, 100e3};
  options.bitrate = kRates[input.byte() % std::size(kRates)];
  options.sample_point = 500 + input.byte() % 400;
  Waveform wave{static_cast<Time>(1e12 / *options.bitrate)};
  std::vector<Frame> sent;
  wave.rest(12);
  while (!input.empty() && sent.size() < 2) {
    const Frame frame = take_frame(input);
    for (const WireBit &bit : encode_frame(frame).bits) wave.put(bit.level);
    wave.rest(3 + input.byte() % 4);
    sent.push_back(frame);
  }
  const WaveDecodeResult result =
      decode_wave(parse_wave(wave.finish(), kFile, options), options.sample_point);
  require(result.events.size() == sent.size(), "as many frames as were on the wire");
  for (std::size_t i = 0; i < sent.size(); ++i) {
    require(result.events[i].kind == BusEventKind::kFrame, "a frame and no error");
    require(result.events[i].frame == sent[i], "the frame that was on the wire");
  }
}

}  // namespace vericansim::fuzz
