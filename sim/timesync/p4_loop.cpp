// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// P4Loop: see p4_loop.hpp.
#include "timesync/p4_loop.hpp"

#include "timesync/picoseconds.hpp"

namespace vericansim {
namespace {

// A frame with eight bytes and one without data at 500 kbit/s, and software between two frames.
constexpr double kLong = 250e3, kShort = 100e3, kSoftware = 100e3;
// The handler reads the clock so much behind the end of a frame (TM-123).
constexpr double kHandlerLeast = 2e3, kHandlerMost = 6e3;
constexpr Nanoseconds kPollGap = 100e3L;
constexpr unsigned kMostPolls = 1000;

}  // namespace

P4Loop::P4Loop(const SyncCase &setting, std::uint64_t seed) : setting_{setting}, dice_{seed} {
  for (unsigned n = 0; n <= setting.followers; ++n) {
    OscillatorError error;
    if (n > 0) error.constant = (n % 2 == 1 ? 1e-6 : -1e-6) * setting.clocks.spread_ppm;
    const Oscillator oscillator{setting.clocks.frequency_hz, error, dice_()};
    nodes.emplace_back(oscillator, dice_() >> 3);
  }
  followers.resize(setting.followers);
  for (unsigned n = 0; n < setting.followers; ++n)
    followers[n].number = static_cast<std::uint8_t>(n + 1);
}

double P4Loop::uniform(double low, double high) {
  return std::uniform_real_distribution<double>{low, high}(dice_);
}

std::uint64_t P4Loop::read_in_handler(ClockNode &node, Nanoseconds event) {
  return node.now(event + uniform(kHandlerLeast, kHandlerMost));
}

const SyncRun &P4Loop::run() {
  for (rounds_ = 0; rounds_ < setting_.intervals; ++rounds_) round();
  return result;
}

void P4Loop::round() {
  const Nanoseconds before = now_;
  now_ += setting_.interval_s * 1e9L;
  const Nanoseconds sync = now_ + uniform(0, kSoftware);
  std::uint8_t follow_up[8];
  verican_p4_write_time(read_in_handler(nodes[0], sync), follow_up);
  for (unsigned n = 0; n < setting_.followers; ++n)
    verican_p4_on_sync(&followers[n], read_in_handler(nodes[n + 1], sync));
  const Nanoseconds handled = sync + kLong + uniform(0, kSoftware);
  look((before + now_) / 2);
  look(handled);
  for (unsigned n = 0; n < setting_.followers; ++n) correct(n, follow_up, handled);
  look(handled + 1e3L);
  for (unsigned n = 0; n < setting_.followers; ++n) measure(n, handled);
}

void P4Loop::correct(unsigned n, const std::uint8_t (&follow_up)[8], Nanoseconds t) {
  ClockNode &node = nodes[n + 1];
  const std::int64_t edge = node.oscillator.last_edge(t);
  const std::int64_t offset = verican_p4_on_follow_up(&followers[n], follow_up, node.at(edge));
  node.apply(edge, {-offset, node.increment(), false, 0});
  verican_p4_shifted(&followers[n], -offset);
  result.actions.push_back(
      {to_picoseconds(t), n, -offset, node.increment(), VERICAN_SERVO_ACCEPTED, 0});
}

// DelayReq, its response, and the report of delay and offset.
void P4Loop::measure(unsigned n, Nanoseconds t) {
  ClockNode &node = nodes[n + 1];
  const Nanoseconds request = wait_for(n, VERICAN_P4_DELAY_REQ, t) + kShort;
  verican_p4_on_sent(&followers[n], read_in_handler(node, request));
  std::uint8_t response[8];
  verican_p4_write_time(read_in_handler(nodes[0], request), response);
  const Nanoseconds answered = request + kLong + uniform(0, kSoftware);
  verican_p4_on_response(&followers[n], response, node.now(answered));
  (void)wait_for(n, VERICAN_P4_DELAY_OFFSET, answered);
}

// When software finds the message due; a message that does not come is not waited for.
Nanoseconds P4Loop::wait_for(unsigned n, std::uint32_t message, Nanoseconds t) {
  std::uint8_t data[8];
  for (unsigned poll = 0; poll < kMostPolls; ++poll, t += kPollGap)
    if (verican_p4_poll(&followers[n], nodes[n + 1].now(t), data) == message) break;
  return t;
}

void P4Loop::look(Nanoseconds t) {
  const std::uint8_t state = rounds_ > 1 ? VERICAN_SYNC_LOCKED : VERICAN_SYNC_ACQUIRING;
  SyncLook look{to_picoseconds(t), {}};
  for (unsigned n = 0; n < setting_.followers; ++n)
    look.followers.push_back({to_picoseconds(nodes[n + 1].ahead_of(nodes[0], t)), state});
  result.looks.push_back(std::move(look));
}

SyncRun run_p4_by_model(const SyncCase &setting, std::uint64_t seed) {
  return P4Loop{setting, seed}.run();
}

}  // namespace vericansim
