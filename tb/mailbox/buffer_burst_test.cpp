// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bursts of accesses by byte, half word and word, in any order and a few clocks apart, around the
// moments at which the core works on the same buffer; the model says which outcomes are allowed.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "harness/depth.hpp"
#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kMb = 5, kOtherMb = 9;
constexpr Frame kBefore{.id = 0x700, .dlc = 0};
constexpr Frame kMine{.id = 0x2AA, .dlc = 1, .data = {0x5A}};
constexpr Frame kOther{.id = 0x300, .dlc = 0};
constexpr std::uint32_t kFlag = 1u << kMb;

AhbTransfer read_of(std::uint32_t address) { return {.address = address}; }
AhbTransfer word(std::uint32_t address, std::uint32_t data) {
  return {.address = address, .write = true, .data = data};
}
AhbTransfer code_of(unsigned mb, unsigned code) { return word(reg::mb(mb), code << 24); }
/// Byte `lane` of the C/S word.
AhbTransfer byte(unsigned mb, unsigned lane, std::uint32_t data) {
  return {.address = reg::mb(mb) + lane, .write = true, .size = AhbSize::kByte, .data = data};
}
/// Its upper half.
AhbTransfer upper(unsigned mb, std::uint32_t data) {
  return {.address = reg::mb(mb) + 2, .write = true, .size = AhbSize::kHalf, .data = data};
}

class Burst : public ::testing::TestWithParam<unsigned> {
 protected:
  Burst() : rng_{GetParam()}, rig_{random_config()} { rig_.go(); }

  bool one_in(unsigned n) { return rng_() % n == 0; }
  unsigned below(unsigned n) { return static_cast<unsigned>(rng_() % n); }
  BufferConfig random_config() {
    BufferConfig config{.num_mb = 16, .maxmb = 15};
    config.bcc = one_in(2);
    config.aen = one_in(2);
    config.eacen = one_in(2);
    config.rrs = one_in(2);
    config.srx_dis = one_in(2);
    config.lbuf = one_in(4);
    return config;
  }
  void burst(const std::vector<AhbTransfer> &transfers, std::uint64_t clock) {
    for (unsigned i = 2 + below(3); i > 0; --i) {
      rig_.at(clock, transfers[below(static_cast<unsigned>(transfers.size()))]);
      clock += below(5);
    }
  }
  /// The peer sends the frame; the clock of its start.
  std::uint64_t begin(const Frame &frame) {
    const std::uint64_t frames = rig_.frames_started();
    rig_.peer_sends(frame);
    EXPECT_TRUE(rig_.run_until([&] { return rig_.frames_started() > frames; }, 800));
    return rig_.start_clock();
  }
  void end() {
    rig_.quiet();
    rig_.compare_quietly();
    rig_.compare();
  }
  void clear() {
    rig_.disturb(0, 0);
    for (unsigned i = 0; i < 2; ++i) {  // AEN=1: a flag protects its buffer
      rig_.write(reg::kIflag1, 0xFFFF);
      rig_.write(reg::mb(kMb), kTxInactive << 24);
      rig_.write(reg::mb(kOtherMb), kTxInactive << 24);
    }
  }
  Frame numbered() {
    const auto number = static_cast<std::uint8_t>(rng_());
    return {.id = 0x123, .dlc = 2, .data = {number, 0x11}};
  }
  void receive_buffer();

  std::mt19937 rng_;
  BufferRig rig_;
};

// Empty, full, overrun, serviced, locked, or locked while a frame waits.
void Burst::receive_buffer() {
  rig_.put_rx(kMb, {.id = 0x123});
  const unsigned state = below(6);
  if (state >= 1) rig_.receive(numbered());
  if (state == 2) rig_.receive(numbered());
  if (state >= 3) rig_.read_cs(kMb);
  if (state == 3) rig_.read(reg::kTimer);
  if (state == 5) rig_.receive(numbered());
  rig_.put(kOtherMb, {.cs = one_in(2) ? kRxEmpty << 24 : 0, .id = 0x123u << 18});
}

// FX-3.4.g, FX-3.5.r, FX-3.6.d, FX-3.6.g: from the last bits of the identifier to behind the move.
TEST_P(Burst, OnAReceiveBuffer) {
  const std::vector<AhbTransfer> transfers{read_of(reg::mb(kMb)),
                                           read_of(reg::kTimer),
                                           read_of(reg::mb(kOtherMb)),
                                           read_of(reg::mb(kMb, 1)),
                                           read_of(reg::kIflag1),
                                           word(reg::kIflag1, kFlag),
                                           code_of(kMb, kRxEmpty),
                                           code_of(kMb, kRxFull),
                                           code_of(kMb, 0),
                                           word(reg::mb(kMb), kRxEmpty << 24 | reg::kCsIde),
                                           byte(kMb, 3, kRxEmpty),
                                           word(reg::mb(kMb), kRxEmpty << 24 | reg::kCsRtr),
                                           byte(kMb, 3, kRxFull),
                                           byte(kMb, 3, 0),
                                           byte(kMb, 0, 0x12),
                                           byte(kMb, 2, 0x02),
                                           upper(kMb, kRxEmpty << 8),
                                           code_of(kMb, kTxInactive),
                                           code_of(kOtherMb, kRxEmpty),
                                           byte(kOtherMb, 3, kRxEmpty),
                                           code_of(kOtherMb, 0)};
  for (unsigned i = depth(20U, 200U); i > 0 && !HasFailure(); --i) {
    clear();
    receive_buffer();
    const std::uint64_t start = begin(numbered());
    burst(transfers, start + (one_in(3) ? 11 * 8 + below(120) : 470 + below(70)));
    end();
    rig_.receive(numbered());
    end();
  }
}

// FX-3.4.a to FX-3.4.g: in the intermission before its frame, or around its end, success or not.
TEST_P(Burst, OnAFrameToBeSent) {
  const std::uint32_t mine = mb_words(kMine, kTxActive).cs;
  const std::vector<AhbTransfer> transfers{code_of(kMb, kTxAbort),
                                           code_of(kMb, kTxInactive),
                                           word(reg::mb(kMb), mine),
                                           byte(kMb, 3, kTxAbort),
                                           byte(kMb, 3, kTxInactive),
                                           byte(kMb, 3, kTxActive),
                                           byte(kMb, 2, 1),
                                           byte(kMb, 0, 0x12),
                                           upper(kMb, mine >> 16),
                                           upper(kMb, kTxAbort << 8),
                                           code_of(kMb, kRxEmpty),
                                           read_of(reg::mb(kMb)),
                                           code_of(kOtherMb, kTxActive),
                                           byte(kOtherMb, 3, kTxInactive),
                                           code_of(kMb, kTxAnswerWaits),
                                           read_of(reg::kTimer)};
  for (unsigned i = depth(20U, 200U); i > 0 && !HasFailure(); --i) {
    clear();
    const std::uint64_t start = begin(kBefore);
    rig_.put_tx(kMb, kMine);
    if (one_in(2)) rig_.put_tx(kOtherMb, kOther);
    if (one_in(3)) {
      burst(transfers, start + 44 * 8 + below(64));
    } else {
      const std::uint64_t frames = rig_.frames_started();
      rig_.run_until([&] { return rig_.frames_started() > frames; }, 800);
      const bool fails = one_in(4);
      if (fails) rig_.disturb(30);
      burst(transfers, rig_.start_clock() + (fails ? 200 : 400) + below(110));
    }
    end();
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Burst, ::testing::Range(1u, 21u));

}  // namespace
}  // namespace vericansim
