// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlTraffic: see rtl_traffic.hpp.
#include "timesync/rtl_traffic.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "timesync/bus_traffic.hpp"

namespace vericansim {
namespace {

// Below and above SYNC's priority.
constexpr std::uint32_t kBelow = 0x400, kAbove = 0x010;
// A dominant level for longer than bit stuffing allows, one bit for the phase of the edges (BS-03).
constexpr unsigned kDisturbed = 7;
// Of the source of errors, whose phase would else be that of the nodes.
constexpr double kPhase = 0.37;

ClockConfig clock_of(double frequency_hz, double error_ppm) {
  ClockConfig config;
  config.frequency_hz = frequency_hz;
  config.error_ppm = error_ppm;
  config.phase = std::llround(kPhase * 1e12 / frequency_hz);
  return config;
}

// Stuffed as often as frames can be.
Frame longest(std::uint32_t id) {
  Frame frame;
  frame.id = id;
  frame.dlc = 8;
  frame.data.fill(0x3C);
  return frame;
}

}  // namespace

ErrorSource::ErrorSource(double bitrate) : Node{"errors", clock_of(bitrate, 0)} {}

void ErrorSource::disturb() {
  disturbed();
  bits_ = kDisturbed;
}

void ErrorSource::clock(Level) {
  drive(bits_ > 0 ? Level::kDominant : Level::kRecessive);
  if (bits_ > 0) --bits_;
}

RtlTraffic::RtlTraffic(Bus &bus, const SyncCase &setting, std::uint64_t seed, At at)
    : bus_{bus},
      at_{std::move(at)},
      bit_{static_cast<double>(kSecond) / setting.bitrate},
      spread_ppm_{setting.clocks.spread_ppm},
      bitrate_{setting.bitrate},
      bit_errors_{setting.bit_errors},
      dice_{seed} {
  if (setting.load > 0) add_sender(kBelow, setting.load);
  if (setting.load_above > 0) add_sender(kAbove, setting.load_above);
  if (bit_errors_ == 0) return;
  errors_ = std::make_unique<ErrorSource>(bitrate_);
  bus_.add(*errors_);
  disturb();
}

void RtlTraffic::add_sender(std::uint32_t id, double load) {
  CoreConfig config;
  config.timing = {.prescaler = 1, .prop = 7, .ps1 = 4, .ps2 = 4, .sjw = 4};
  const double error = std::uniform_real_distribution<double>{-spread_ppm_, spread_ppm_}(dice_);
  senders_.push_back(
      std::make_unique<CoreNode>("load" + std::to_string(senders_.size()), config,
                                 clock_of(bitrate_ * config.timing.clocks_per_bit(), error)));
  CoreNode &sender = *senders_.back();
  bus_.add(sender);
  sender.start();
  send(sender, id, load);
}

// One frame waits behind the one on the wire at most: a bus that is full stays so, and what has no
// place on it is given up.
void RtlTraffic::send(CoreNode &sender, std::uint32_t id, double load) {
  sender.received().clear();
  sender.sent().clear();
  if (sender.waiting() < 2) sender.request(longest(id));
  const double mean = kLongestBaseFrame * bit_ / load;
  const double gap = load < 1 ? std::exponential_distribution<double>{1 / mean}(dice_) : mean / 2;
  at_(bus_.now() + std::llround(gap), [this, &sender, id, load] { send(sender, id, load); });
}

void RtlTraffic::disturb() {
  const double gap = std::exponential_distribution<double>{bit_errors_ / bit_}(dice_);
  at_(bus_.now() + std::llround(gap), [this] {
    if (!silent() || others_send()) {
      errors_->disturb();
      on_error();
    }
    disturb();
  });
}

bool RtlTraffic::silent() const {
  for (const auto &sender : senders_)
    if (sender->pending()) return false;
  return true;
}

}  // namespace vericansim
