// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FramePort: what the engine would tell, in its order and never faster than eight clocks a bit.
#include "remote/frame_port.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace vericansim {
namespace {

constexpr unsigned kDlcBits = 4;
constexpr unsigned kCrcBits = 2;    // few of them: the node waits for EOF6
constexpr unsigned kHeadBits = 18;  // ID to DLC

unsigned bytes_of(const Frame &frame) {
  return frame.remote ? 0 : std::min<unsigned>(frame.dlc, 8);
}

}  // namespace

void FramePort::reset() {
  engine_ = {};
  hold_reset(true);
  clocks(2);
  hold_reset(false);
  for (unsigned waited = 0; !ready(); ++waited) {
    if (waited == 4200) throw std::logic_error("the RAM is not cleared in 4,200 clocks");
    clock();
  }
  pulses_.clear();
}

void FramePort::do_what_is_due() {
  std::vector<std::pair<std::uint64_t, std::function<void()>>> due;
  const auto now = std::stable_partition(later_.begin(), later_.end(), [this](const auto &entry) {
    return entry.first > clocks_ + 1;
  });
  std::move(now, later_.end(), std::back_inserter(due));
  later_.erase(now, later_.end());
  for (const auto &entry : due) entry.second();
}

void FramePort::clock() {
  if (!later_.empty()) do_what_is_due();
  edge(engine_);
  ++clocks_;
  engine_.tick = engine_.hdr = engine_.byte_we = engine_.valid = false;
  engine_.next = engine_.ok = engine_.fail = engine_.ms = false;
  for (const RemotePulse &seen : pulses()) {
    pulses_.push_back(seen);
    pulse_clock_ = clocks_;
  }
}

void FramePort::bit() {
  engine_.tick = true;
  clocks(kBit);
}

// The sample point, the pulses that follow it, the rest of the bit.
void FramePort::pulses_in(bool Engine::*event) {
  engine_.tick = true;
  clock();
  engine_.*event = true;
  clock();
  clocks(kBit - 2);
}

void FramePort::receive_until_valid(const Frame &frame, unsigned bits) {
  engine_.gap = false;
  engine_.transmitter = false;
  engine_.ide = frame.extended;
  engine_.rtr = frame.remote;
  engine_.id = frame.extended ? frame.id >> 18 : frame.id;
  pulses_in(&Engine::hdr);
  for (unsigned i = 1; i < kDlcBits; ++i) {
    if (i == 3) engine_.id ^= 0x7FF;  // it was valid for three bits
    bit();
  }
  engine_.dlc = frame.dlc;
  for (unsigned i = 0; i < bytes_of(frame); ++i) {
    for (unsigned b = 1; b < bits; ++b) bit();
    engine_.byte = frame.data[i];
    pulses_in(&Engine::byte_we);
    engine_.byte ^= 0x55;  // it was valid for a bit
  }
  for (unsigned i = 0; i < kCrcBits; ++i) bit();
  engine_.tick = true;
  clock();
  engine_.valid = true;
  clock();
}

void FramePort::receive(const Frame &frame, unsigned bits) {
  receive_until_valid(frame, bits);
  clocks(kBit - 2);
  engine_.tick = true;  // EOF7
  clock();
  engine_.gap = true;
  clocks(kBit - 1);
  for (int i = 0; i < 3; ++i) bit();  // INT1 to INT3
}

void FramePort::receive_broken(const Frame &frame, unsigned bytes) {
  Frame part = frame;
  part.dlc = static_cast<std::uint8_t>(std::min<unsigned>(bytes, bytes_of(frame)));
  engine_.gap = false;
  engine_.transmitter = false;
  engine_.ide = frame.extended;
  engine_.rtr = frame.remote;
  engine_.id = frame.id;
  pulses_in(&Engine::hdr);
  for (unsigned i = 1; i < kDlcBits; ++i) bit();
  engine_.dlc = frame.dlc;
  for (unsigned i = 0; i < part.dlc; ++i) {
    engine_.byte = frame.data[i];
    pulses_in(&Engine::byte_we);
  }
  for (unsigned i = 0; i < 14; ++i) bit();  // error flag and delimiter
  engine_.gap = true;
  for (unsigned i = 0; i < 3; ++i) bit();
}

bool FramePort::asks() const { return asked().request; }

Frame FramePort::send(End end) {
  const Asked taken = asked();
  if (!taken.request) throw std::logic_error("the node sends nothing");
  Frame frame;
  frame.id = taken.word >> 18 & 0x7FF;
  frame.dlc = static_cast<std::uint8_t>(taken.dlc);
  engine_.tick = true;
  clock();
  engine_.next = true;
  engine_.gap = false;
  engine_.transmitter = true;
  clock();
  clocks(kBit - 2);
  // At the end of the DLC the first byte is taken, whether it is sent or not; each of the others
  // with the last bit of the one before it.
  const unsigned bytes = std::max(1U, bytes_of(frame));
  for (unsigned i = 0; i < bytes && end != End::kLost; ++i) {
    for (unsigned b = 1; b < (i == 0 ? kHeadBits : 8); ++b) bit();
    frame.data[i] = static_cast<std::uint8_t>(asked().word >> 18);
    pulses_in(&Engine::next);
  }
  for (unsigned i = frame.dlc; i < 8; ++i) frame.data[i] = 0;
  engine_.tick = true;
  clock();
  if (end == End::kLost) engine_.transmitter = false;
  (end == End::kSent ? engine_.ok : engine_.fail) = true;
  if (end == End::kSent) engine_.gap = true;
  clock();
  clocks(kBit - 2);
  if (end == End::kLost) return frame;  // somebody else's header follows
  for (int i = 0; i < (end == End::kError ? 14 : 0); ++i) bit();
  engine_.gap = true;
  for (int i = 0; i < 3; ++i) bit();
  engine_.transmitter = false;
  return frame;
}

std::vector<Frame> FramePort::drain() {
  std::vector<Frame> sent;
  for (unsigned bits = 0; bits < 12; ++bits) {
    if (asks()) {
      sent.push_back(send());
      bits = 0;
    }
    bit();
  }
  return sent;
}

void FramePort::ms() {
  pulse_ms();
  clocks(640);
}

std::uint32_t FramePort::user(const UserAccess &access) {
  show(access);
  for (unsigned waited = 0; !ready(); ++waited) {
    if (waited == 10'000) throw std::logic_error("usr_ready_o stays 0");
    clock();
  }
  clock();
  show(std::nullopt);
  return read_data();
}

std::vector<RemotePulse> FramePort::take_pulses() {
  std::vector<RemotePulse> pulses;
  pulses.swap(pulses_);
  return pulses;
}

}  // namespace vericansim
