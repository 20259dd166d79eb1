// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ClockWorld: see clock_world.hpp.
#include "softerror/clock/clock_world.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <utility>

namespace vericansim {
namespace {

constexpr ClockConfig kClock{.frequency_hz = kNodeHz, .error_ppm = 60, .phase = 12'345};
constexpr std::uint64_t kEpoch = 1'700'000'000'999'000'000;
constexpr Time kNever = std::numeric_limits<Time>::max();
constexpr Time kFollowUp = 300 * kBit;          // behind SYNC
constexpr Time kSoftware = 200 * kMicrosecond;  // it runs this often
constexpr Time kIdle = 10 * kBit;               // then a dominant bit is an SOF
// An access takes a clock or two; a wait of more than this never ends.
constexpr unsigned kLongestWait = 64;
// As the driver leaves it, with the fastest slew.
constexpr std::uint32_t kTctrl = VERICAN_TCTRL_RESET;
constexpr std::uint32_t kLaunchId = 0x155;

void expect(verican_result_t result) {
  if (result != VERICAN_OK) throw std::runtime_error(verican_result_name(result));
}

std::uint64_t mixed(std::uint64_t digest, const void *data, std::size_t size) {
  const auto *byte = static_cast<const unsigned char *>(data);
  for (std::size_t i = 0; i < size; ++i) digest = (digest ^ byte[i]) * 0x100000001B3ULL;
  return digest;
}

}  // namespace

ClockWorld::ClockWorld(ClockScene scene)
    : source{kBitrate, kEpoch},
      other{"other",
            {.timing = {.prescaler = 1, .prop = 2, .ps1 = 3, .ps2 = 2, .sjw = 1}},
            {.frequency_hz = kNodeHz}},
      scene_{scene},
      dut_{new FlopNode{"node", kClock}},
      node_{std::unique_ptr<RtlNode>{dut_}, kClock} {
  bus.add(*dut_);
  bus.add(source);
  bus.add(other);
  other.start();
  node_.config.bitrate = static_cast<std::uint32_t>(kBitrate);
  node_.config.abort = true;
  node_.config.port.context = this;
  node_.config.port.read32 = [](void *self, std::uint32_t offset) {
    return static_cast<ClockWorld *>(self)->read(offset);
  };
  node_.config.port.write32 = [](void *self, std::uint32_t offset, std::uint32_t value) {
    static_cast<ClockWorld *>(self)->write(offset, value);
  };
  set_up();
  if (bus.now() > kFirst) throw std::runtime_error("the set-up takes too long");
  next_pair = next_follow_up_ = next_launch_ = kNever;
  if (scene == ClockScene::kTime) {
    next_pair = kFirst;
    follow();
  } else {
    next_launch_ = kFirst;
  }
}

void ClockWorld::follow() {
  verican_tsyn_config_t config{};
  expect(verican_tsyn_config_default(&config));
  config.masters[0] = kTsynId;
  config.rules.domain = kTsynDomain;
  config.servo.interval_us = static_cast<std::uint32_t>(kPairs / kMicrosecond);
  config.servo.filter = 8;
  config.user = this;
  config.on_event = [](void *self, verican_tsyn_t *, std::uint8_t events) {
    static_cast<ClockWorld *>(self)->servo_events |= events & ~VERICAN_SERVO_ACCEPTED;
  };
  expect(verican_tsyn_init(&tsyn, dev(), &config));
  expect(verican_tsyn_start_follower(&tsyn));
}

void ClockWorld::step_bus() {
  bus.step();
  watch();
}

void ClockWorld::watch() {
  const bool dominant = dut_->tx() == Level::kDominant;
  if (dominant && !dominant_) {
    dominant_since_ = bus.now();
    if (bus.now() - recessive_since_ > kIdle) sof = bus.now();
  }
  if (dominant) longest_dominant_ = std::max(longest_dominant_, bus.now() - dominant_since_);
  dominant_ = dominant;
  if (dominant || bus.level() == Level::kDominant) recessive_since_ = bus.now();
  if (dut_->time_out() != out_) pulses.push_back({bus.now(), !out_});
  out_ = dut_->time_out();
}

AhbResult ClockWorld::access(const AhbTransfer &transfer) {
  const auto ticket = dut_->master().submit(transfer);
  while (!dut_->master().done(ticket)) {
    if (dut_->longest_wait() > kLongestWait) {
      if (on_hang) on_hang();
      throw std::runtime_error("an access does not end");
    }
    step_bus();
  }
  return dut_->master().result(ticket);
}

std::uint32_t ClockWorld::read(std::uint32_t offset) { return access({.address = offset}).data; }

void ClockWorld::write(std::uint32_t offset, std::uint32_t value) {
  (void)access({.address = offset, .write = true, .data = value});
}

void ClockWorld::step() {
  step_bus();
  node_.serve();
  if (dut_->irq_time()) (void)verican_clock_irq_handler(dev());
  play();
  if (bus.now() < next_software_) return;
  next_software_ = bus.now() + kSoftware;
  software();
}

// What the master does, and when the node launches.
void ClockWorld::play() {
  if (over_) return;
  if (bus.now() >= next_pair) {
    source.sync();
    ++pairs;
    next_follow_up_ = next_pair + kFollowUp;
    next_pair += kPairs;
  }
  if (bus.now() >= next_follow_up_) {
    source.follow_up();
    next_follow_up_ = kNever;
  }
  if (bus.now() >= next_launch_) {
    next_launch_ += kLaunches;
    launch();
  }
}

void ClockWorld::launch() {
  std::uint64_t now = 0;
  (void)verican_clock_get(dev(), &now);
  const verican_frame_t frame = driver_frame(kLaunchId);
  expect(verican_send_at(dev(), &frame, now + kLaunchIn, nullptr));
  ++launches;
}

// What a program does: frames, the domain, and a look at TCTRL, which keeps an upset for ever.
void ClockWorld::software() {
  const bool follows = scene_ == ClockScene::kTime && !over_;
  for (const verican_frame_t &frame : node_.received())
    if (!follows || verican_tsyn_on_frame(&tsyn, &frame) != VERICAN_OK) others.push_back(frame);
  if (over_) return;
  if (follows) (void)verican_tsyn_poll(&tsyn);
  if (read(VERICAN_TCTRL_OFFSET) != kTctrl) write(VERICAN_TCTRL_OFFSET, kTctrl);
  if (follows) worst = std::max(worst, std::abs(error()));
}

void ClockWorld::run_to(Time end) {
  while (bus.now() < end) step();
}

bool ClockWorld::run_until(const std::function<bool()> &done, Time limit) {
  for (const Time end = bus.now() + limit; !done(); step())
    if (bus.now() >= end) return false;
  return true;
}

std::uint64_t ClockWorld::time_at(Time at) const {
  const Clock &clock = std::as_const(*dut_).oscillator();
  const double edges = 1 - static_cast<double>(clock.next() - at) / clock.period_ps();
  const double since = edges * std::ldexp(static_cast<double>(node_.dev.increment), -32);
  return dut_->time_of_clock() + static_cast<std::uint64_t>(std::llround(since));
}

double ClockWorld::error() const {
  return static_cast<double>(
      static_cast<std::int64_t>(time_at(bus.now()) - source.time(bus.now())));
}

void ClockWorld::rewrite() {
  write(VERICAN_TCTRL_OFFSET, kTctrl);
  write(VERICAN_TSLEW_OFFSET, 0);
  write(VERICAN_TTXMB_OFFSET, 0);
  write(VERICAN_TSTAT_OFFSET, ~0U);
  (void)verican_clock_rate(dev(), node_.dev.increment);
}

void ClockWorld::set_up() {
  expect(node_.up());
  ask(0);
}

void ClockWorld::ask(std::uint32_t events) {
  const auto told = [](void *self, verican_t *, std::uint32_t flags, std::uint64_t time_ns) {
    static_cast<ClockWorld *>(self)->clock_flags |= flags;
    static_cast<ClockWorld *>(self)->event_time = time_ns;
  };
  clock_flags = 0;
  expect(verican_clock_on_event(dev(), events, told, this));
}

void ClockWorld::reset() {
  dut_->reset();
  set_up();
}

void ClockWorld::last_launch() { next_launch_ = kNever; }

void ClockWorld::end_scene() {
  over_ = true;
  (void)node_.received();
  others.clear();
}

std::uint64_t ClockWorld::state() const {
  std::uint64_t digest = mixed(dut_->state(), &tsyn, sizeof tsyn);
  digest = mixed(digest, &node_.dev, sizeof node_.dev);
  return digest ^ dut_->seen_on_bus();
}

}  // namespace vericansim
