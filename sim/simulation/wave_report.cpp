// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A report of a recorded waveform: see wave_report.hpp.
#include "simulation/wave_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "bus/faults.hpp"
#include "bus/range.hpp"
#include "node/host.hpp"
#include "simulation/bus_outputs.hpp"
#include "simulation/stop_request.hpp"

namespace vericansim {
namespace {

/// 20 quanta of one clock, sample point 80 %, the widest SJW.
constexpr BitTiming kTiming{1, 7, 8, 4, 4};

/// The level that the listener receives, whoever drives.
class Recording : public Fault {
 public:
  [[nodiscard]] Level level(NodeId receiver, Time, Level level) override {
    return receiver == kBusPoint ? level : now;
  }
  Level now = Level::kRecessive;
};

class Player {
 public:
  Player(const Wave &wave, const std::string &title, const Outputs &outputs);
  WaveReport play(const std::function<void(double)> &progress);

 private:
  void next(std::size_t change);
  [[nodiscard]] std::optional<Time> rest();

  const Wave &wave_;
  Time bit_time_;
  Recording recording_;
  std::unique_ptr<RtlNode> node_;
  std::unique_ptr<Host> host_;
  std::unique_ptr<BusMonitor> monitor_;
  std::unique_ptr<BusOutputs> outputs_;
  Bus bus_;
  Time start_ = 0;  // where the recording has its time 0
};

HostConfig listener() {
  HostConfig config;
  config.timing = kTiming;
  config.listen_only = true;
  return config;
}

// The core is on the bus, and integrates, when the recording begins.
Player::Player(const Wave &wave, const std::string &title, const Outputs &outputs)
    : wave_{wave}, bit_time_{bit_time_of(wave.bitrate)} {
  ClockConfig clock;
  clock.frequency_hz = wave.bitrate * kTiming.clocks_per_bit();
  node_ = RtlNode::create("listener", clock, 16);
  bus_.add(*node_);
  host_ = std::make_unique<Host>(*node_, listener());
  host_->on_received = [](const HostFrame &) {};
  outputs_ = std::make_unique<BusOutputs>(outputs, bus_, bit_time_);
  host_->start_and_wait();
  monitor_ = std::make_unique<BusMonitor>(bus_, bit_time_, 0.8);
  monitor_->on_frame = [this](const BusFrame &frame) { outputs_->write(frame); };
  bus_.add(*monitor_);
  outputs_->record(bus_, *monitor_,
                   {title, "Recorded: " + wave.signal, wave.bitrate, bit_time_, {kTiming}});
  bus_.add(recording_);
}

/// Takes over change number `change` now, and arranges for the one behind it.
void Player::next(std::size_t change) {
  const auto &changes = wave_.changes;
  if (changes[change].second != recording_.now) {
    recording_.now = changes[change].second;
    monitor_->on_level(bus_.now(), recording_.now);
    outputs_->on_level(bus_.now(), recording_.now);
  }
  if (++change < changes.size())
    bus_.at(start_ + changes[change].first, [this, change] { next(change); });
}

/// Behind the end of the waveform: what ends a last frame may be cut off, but nobody knows whether
/// a frame without its acknowledge has had one. No bit more than it needs, for the page counts them
/// as time of the recording. Returns where the frame began that stays cut, ps.
std::optional<Time> Player::rest() {
  constexpr unsigned kMost = 24, kIntermission = 3;  // bits
  const BusDecoder &decoder = monitor_->decoder();
  monitor_->advance(bus_.now());
  const bool ends = decoder.under_way() && !decoder.before_ack_delimiter();
  for (unsigned bit = 0; ends && decoder.under_way() && bit < kMost; ++bit) {
    bus_.run_for(bit_time_);
    monitor_->advance(bus_.now());
  }
  if (ends) bus_.run_for(kIntermission * bit_time_);
  const std::optional<Time> begin = decoder.under_way();
  return begin ? std::optional{*begin - start_} : std::nullopt;
}

WaveReport Player::play(const std::function<void(double)> &progress) {
  constexpr Time kPart = 1'000;  // bits
  const Time begin = bus_.now();
  start_ = begin - wave_.begin();
  outputs_->begin(start_);
  if (!wave_.changes.empty()) bus_.at(begin, [this] { next(0); });
  const Time end = start_ + wave_.end;
  while (bus_.now() < end && !stop_requested()) {
    bus_.run_until(std::min(end, bus_.now() + kPart * bit_time_));
    host_->check();
    if (progress)
      progress(static_cast<double>(bus_.now() - begin) / static_cast<double>(end - begin));
  }
  const bool interrupted = bus_.now() < end;
  const std::optional<Time> cut = rest();
  outputs_->finish(bus_.now());
  ReportExtras extras;
  extras.zero = start_;
  outputs_->write_report(extras);
  return {monitor_->frames(),          interrupted,
          monitor_->unacknowledged(),  monitor_->error_frames(),
          monitor_->overload_frames(), interrupted ? std::nullopt : cut};
}

}  // namespace

WaveReport report_wave(const Wave &wave, const std::string &title, const Outputs &outputs,
                       const std::function<void(double)> &progress) {
  return Player{wave, title, outputs}.play(progress);
}

}  // namespace vericansim
