// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The paper's experiments with good frames: reception, transmission, arbitration (figures 11 to
// 13).
#include <fmt/format.h>

#include <algorithm>

#include "model/frame_codec.hpp"
#include "paper/paper_bench.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

// The paper gives no frequency: a prescaler of 16 makes quanta of 2 us from 8 MHz.
constexpr BitTiming kPaperTiming{16, 5, 2, 2, 1};

constexpr const char *kPaperNote =
    "Son, Park, Kang (2016): 50 kbit/s, 10 quanta of 2 us, sample point 80 %";

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

bool in_ack_slot(const BitRecord &bit) { return bit.at.field == Field::kAck; }

std::string received_text(const std::vector<Frame> &frames) {
  std::string text;
  for (const Frame &frame : frames) text += (text.empty() ? "" : ", ") + candump_frame(frame);
  return text.empty() ? "nothing" : text;
}

}  // namespace

PaperBench::PaperBench(const PaperFiles &files, const std::string &title, bool alone) {
  stations_.add(bus_, make_station("ip", ClockConfig{}, host_config()), {});
  if (!alone) stations_.add(bus_, make_station("other", other_clock(), host_config()), {});
  bus_.add(log_);
  monitor_ = std::make_unique<BusMonitor>(bus_, kBit, 0.8);
  monitor_->on_frame = [this](const BusFrame &frame) { outputs_->write(frame); };
  bus_.add(*monitor_);
  Outputs outputs;
  (files.wave.ends_with(".fst") ? outputs.fst : outputs.vcd) = files.wave;
  outputs.report = files.page;
  outputs_ = std::make_unique<BusOutputs>(outputs, bus_, kBit);
  const std::vector<BitTiming> timings(stations_.size(), kPaperTiming);
  outputs_->record(bus_, *monitor_, {title, kPaperNote, 1e12 / kBit, kBit, timings});
  stations_.join(bus_, kBit);
  outputs_->begin(bus_.now());
}

void PaperBench::add(Fault &fault) {
  bus_.add(fault);
  outputs_->begin(bus_.now());
}

void PaperBench::finish(const PaperExperiment &experiment, Time from, Time to) {
  monitor_->advance(bus_.now());
  outputs_->finish(bus_.now());
  ReportExtras extras;
  for (const PaperCheck &check : experiment.checks)
    extras.statements.push_back({check.figure, check.reported, check.seen, check.ok, check.time});
  extras.view = {from, to};
  outputs_->write_report(extras);
}

Time first_sof(const std::vector<BitRecord> &bits) {
  return time_of(bits, [](const BitRecord &b) {
    return b.at.rx == Level::kDominant && b.at.field != Field::kInteg;
  });
}

void PaperBench::run_bits(Time bits) {
  bus_.run_for(bits * kBit);
  stations_.check();
}

bool PaperBench::run_until(const std::function<bool()> &done, Time bits) {
  const bool result = bus_.run_until(done, bits * kBit);
  stations_.check();
  return result;
}

PaperExperiment paper_reception(const PaperFiles &files) {
  PaperBench bench{files, "Figure 11: reception", false};
  bench.send(PaperBench::kOther, kPaperFrame);
  bench.run_bits(90);
  const Station &ip = bench.station(PaperBench::kIp);
  const auto &bits = bench.bits(PaperBench::kIp);
  const std::string driven = dominant_fields(bits);
  const Time sof = first_sof(bits);
  const Time valid = time_of(bits, [](const BitRecord &b) { return b.after.rx_valid; });
  PaperExperiment result{"reception", files};
  result.checks.push_back({"11", "the IP receives identifier 0b00000001010 with data 0b10101010",
                           received_text(ip.received),
                           ip.received == std::vector<Frame>{kPaperFrame}, valid});
  result.checks.push_back({"11", "the IP drives the ACK slot, and nothing else", "drives " + driven,
                           driven == "ACK", time_of(bits, in_ack_slot)});
  const bool same = same_bits(bits, encode_frame(kPaperFrame));
  result.checks.push_back({"11", "the bits are those of the frame",
                           same ? "the same as the frame codec's" : "others", same, sof});
  bench.finish(result, sof - 3 * PaperBench::kBit, valid + 6 * PaperBench::kBit);
  return result;
}

PaperExperiment paper_transmission(const PaperFiles &files) {
  PaperBench bench{files, "Figure 12: transmission", false};
  bench.send(PaperBench::kIp, kPaperFrame);
  bench.run_bits(90);
  const auto &bits = bench.bits(PaperBench::kIp);
  const auto ack = std::find_if(bits.begin(), bits.end(), in_ack_slot);
  const bool by_other =
      ack != bits.end() && ack->at.tx == Level::kRecessive && ack->at.rx == Level::kDominant;
  const Station &other = bench.station(PaperBench::kOther);
  const Time sof = first_sof(bits);
  const Time sent = time_of(bits, [](const BitRecord &b) { return b.after.tx_ok; });
  PaperExperiment result{"transmission", files};
  result.checks.push_back({"12", "the IP sends the frame and the other node receives it",
                           received_text(other.received),
                           other.received == std::vector<Frame>{kPaperFrame}, sent});
  result.checks.push_back(
      {"12", "the other node drives the ACK slot",
       by_other ? "the IP sends recessive and sees dominant" : "no acknowledge by the other node",
       by_other, time_of(bits, in_ack_slot)});
  const bool same = same_bits(bits, encode_frame(kPaperFrame));
  result.checks.push_back({"12", "the bits are those of the frame",
                           same ? "the same as the frame codec's" : "others", same, sof});
  bench.finish(result, sof - 3 * PaperBench::kBit, sent + 5 * PaperBench::kBit);
  return result;
}

PaperExperiment paper_arbitration(const PaperFiles &files) {
  Frame loser = kPaperFrame;
  loser.id = 0b00000001011;
  PaperBench bench{files, "Figure 13: arbitration", false};
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
  const Time lost_at = time_of(bits, [](const BitRecord &b) { return b.after.tx_fail; });
  const Time received =
      time_of(bits, [](const BitRecord &b) { return b.after.rx_valid && !b.after.transmitter; });
  const Time sent = time_of(bits, [](const BitRecord &b) { return b.after.tx_ok; });
  PaperExperiment result{"arbitration", files};
  result.checks.push_back(
      {"13", "the IP (0b00000001011) stops where it sees the other's dominant bit (0b00000001010)",
       lost == bits.end() ? "it does not lose"
                          : fmt::format("loses at bit {} of {} without an error",
                                        10 - lost->at.left, field_name(lost->at.field)),
       at_last_bit, lost_at});
  result.checks.push_back({"13", "the IP becomes receiver of the other's frame",
                           received_text(ip.received),
                           ip.received == std::vector<Frame>{kPaperFrame}, received});
  result.checks.push_back({"13", "the IP's frame follows", received_text(other.received),
                           other.received == std::vector<Frame>{loser}, sent});
  const unsigned tec = bits.back().after.tec;
  result.checks.push_back(
      {"13", "a lost arbitration is no error", fmt::format("TEC {}", tec), tec == 0, lost_at});
  bench.finish(result, first_sof(bits) - 3 * PaperBench::kBit, lost_at + 12 * PaperBench::kBit);
  return result;
}

}  // namespace vericansim
