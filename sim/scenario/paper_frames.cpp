// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The paper's experiments with good frames: reception, transmission, arbitration (figures 11 to
// 13).
#include <fmt/format.h>

#include <algorithm>

#include "model/frame_codec.hpp"
#include "scenario/paper_bench.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

// The paper gives no frequency: a prescaler of 16 makes quanta of 2 us from 8 MHz.
constexpr BitTiming kPaperTiming{16, 5, 2, 2, 1};

HostConfig host_config() {
  HostConfig config;
  config.timing = kPaperTiming;
  return config;
}

/// The other node's crystal is 50 ppm off and out of phase, as two boards are.
ClockConfig other_clock() {
  ClockConfig clock;
  clock.error_ppm = 50;
  clock.phase = 61 * kNanosecond;
  return clock;
}

/// Fields in which a node drives the bus dominant, without repetition, in order.
std::string dominant_fields(const std::vector<BitRecord> &bits) {
  std::string text;
  std::string_view last;
  for (const BitRecord &bit : bits) {
    const std::string_view name = field_name(bit.at.field);
    if (bit.at.tx != Level::kDominant || name == last) continue;
    text += (text.empty() ? "" : ", ") + std::string(name);
    last = name;
  }
  return text.empty() ? "nothing" : text;
}

/// Levels sampled by a node from the first SOF on, as many as there are in `like`.
bool same_bits(const std::vector<BitRecord> &bits, const EncodedFrame &like) {
  const auto sof = std::find_if(bits.begin(), bits.end(), [](const BitRecord &b) {
    return b.at.rx == Level::kDominant && b.at.field != Field::kInteg;
  });
  if (static_cast<std::size_t>(bits.end() - sof) < like.bits.size()) return false;
  return std::equal(
      like.bits.begin(), like.bits.end(), sof,
      [](const WireBit &wire, const BitRecord &bit) { return wire.level == bit.at.rx; });
}

std::string received_text(const std::vector<Frame> &frames) {
  std::string text;
  for (const Frame &frame : frames) text += (text.empty() ? "" : ", ") + candump_frame(frame);
  return text.empty() ? "nothing" : text;
}

}  // namespace

PaperBench::PaperBench(const std::string &wave, bool alone) {
  stations_.add(bus_, make_station("ip", ClockConfig{}, host_config()), {});
  if (!alone) stations_.add(bus_, make_station("other", other_clock(), host_config()), {});
  bus_.add(log_);
  Outputs outputs;
  (wave.ends_with(".fst") ? outputs.fst : outputs.vcd) = wave;
  outputs_ = std::make_unique<BusOutputs>(outputs, bus_, kBit);
  stations_.join(bus_, kBit);
}

PaperBench::~PaperBench() { outputs_->finish(bus_.now()); }

void PaperBench::run_bits(Time bits) {
  bus_.run_for(bits * kBit);
  stations_.check();
}

bool PaperBench::run_until(const std::function<bool()> &done, Time bits) {
  const bool result = bus_.run_until(done, bits * kBit);
  stations_.check();
  return result;
}

PaperExperiment paper_reception(const std::string &wave) {
  PaperBench bench{wave, false};
  bench.send(PaperBench::kOther, kPaperFrame);
  bench.run_bits(90);
  const Station &ip = bench.station(PaperBench::kIp);
  const std::string driven = dominant_fields(bench.bits(PaperBench::kIp));
  PaperExperiment result{"reception", wave, {}};
  result.checks.push_back({"11", "the IP receives identifier 0b00000001010 with data 0b10101010",
                           received_text(ip.received),
                           ip.received == std::vector<Frame>{kPaperFrame}});
  result.checks.push_back(
      {"11", "the IP drives the ACK slot, and nothing else", "drives " + driven, driven == "ACK"});
  const bool same = same_bits(bench.bits(PaperBench::kIp), encode_frame(kPaperFrame));
  result.checks.push_back({"11", "the bits are those of the frame",
                           same ? "the same as the frame codec's" : "others", same});
  return result;
}

PaperExperiment paper_transmission(const std::string &wave) {
  PaperBench bench{wave, false};
  bench.send(PaperBench::kIp, kPaperFrame);
  bench.run_bits(90);
  const auto &bits = bench.bits(PaperBench::kIp);
  const auto ack = std::find_if(bits.begin(), bits.end(),
                                [](const BitRecord &b) { return b.at.field == Field::kAck; });
  const bool by_other =
      ack != bits.end() && ack->at.tx == Level::kRecessive && ack->at.rx == Level::kDominant;
  const Station &other = bench.station(PaperBench::kOther);
  PaperExperiment result{"transmission", wave, {}};
  result.checks.push_back({"12", "the IP sends the frame and the other node receives it",
                           received_text(other.received),
                           other.received == std::vector<Frame>{kPaperFrame}});
  result.checks.push_back(
      {"12", "the other node drives the ACK slot",
       by_other ? "the IP sends recessive and sees dominant" : "no acknowledge by the other node",
       by_other});
  const bool same = same_bits(bits, encode_frame(kPaperFrame));
  result.checks.push_back({"12", "the bits are those of the frame",
                           same ? "the same as the frame codec's" : "others", same});
  return result;
}

PaperExperiment paper_arbitration(const std::string &wave) {
  Frame loser = kPaperFrame;
  loser.id = 0b00000001011;
  PaperBench bench{wave, false};
  bench.send(PaperBench::kIp, loser);
  bench.send(PaperBench::kOther, kPaperFrame);
  bench.run_bits(160);
  const auto &bits = bench.bits(PaperBench::kIp);
  // The last bit that the IP sends as a transmitter before it has lost.
  const auto lost =
      std::find_if(bits.begin(), bits.end(), [](const BitRecord &b) { return b.after.tx_fail; });
  const bool at_last_bit = lost != bits.end() && lost->at.field == Field::kId &&
                           lost->at.left == 0 && lost->after.errors == 0;
  const Station &ip = bench.station(PaperBench::kIp);
  const Station &other = bench.station(PaperBench::kOther);
  PaperExperiment result{"arbitration", wave, {}};
  result.checks.push_back(
      {"13", "the IP (0b00000001011) stops where it sees the other's dominant bit (0b00000001010)",
       lost == bits.end() ? "it does not lose"
                          : fmt::format("loses at bit {} of {} without an error",
                                        10 - lost->at.left, field_name(lost->at.field)),
       at_last_bit});
  result.checks.push_back({"13", "the IP becomes receiver of the other's frame",
                           received_text(ip.received),
                           ip.received == std::vector<Frame>{kPaperFrame}});
  result.checks.push_back({"13", "the IP's frame follows", received_text(other.received),
                           other.received == std::vector<Frame>{loser}});
  const unsigned tec = bits.back().after.tec;
  result.checks.push_back(
      {"13", "a lost arbitration is no error", fmt::format("TEC {}", tec), tec == 0});
  return result;
}

}  // namespace vericansim
