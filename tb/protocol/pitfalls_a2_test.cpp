// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Pitfalls PF-15..PF-28: what other controllers got wrong in frames, CRC, flags and the end of
// frame.
#include <gtest/gtest.h>

#include "protocol/steps_a.hpp"

namespace vericansim {
namespace {

const Frame kEight = base_frame(0x2C5, {0x81, 0x42, 0x24, 0x18, 0xC3, 0x3C, 0xA5, 0x5A});

std::string acknowledge(const Frame &frame) {
  return flipped(r_bits(wire(frame).size()), ack_offset(frame));
}

// PF-15: a stuff error at every bit of DATA, then a good frame of eight bytes: its bytes stand
// where they belong.
TEST(Pitfall, BrokenDataLeavesNoByteCounter) {
  const std::string bits = wire(kEight);
  const std::size_t end = offset_of(kEight, Field::kCrc, 14);
  for (std::size_t at = offset_of(kEight, Field::kData, 0); at < end; ++at) {
    Scene scene;
    std::string lt = bits.substr(0, at + 1);
    const char last = lt.back();
    const std::size_t run = lt.size() - 1 - lt.find_last_of(last == '0' ? '1' : '0');
    if (lt.size() + 6 - run > end + 1) continue;
    lt += std::string(6 - run, last);
    EXPECT_EQ(scene.play(lt + r_bits(6)), r_bits(lt.size()) + d_bits(6)) << at;
    scene.play(r_bits(8 + 3));
    scene.expect_reception(kEight);
  }
}

// PF-16: seventy frames that nobody fetches: each is acknowledged and handed over, none is lost
// and none comes twice.
TEST(Pitfall, SeventyFramesInARowAreAllHandedOver) {
  Scene scene;
  std::vector<Frame> sent;
  for (std::uint32_t i = 0; i < 70; ++i) {
    sent.push_back(base_frame(i * 29 % 0x800, {static_cast<std::uint8_t>(i)}));
    scene.expect_reception(sent.back());
  }
  EXPECT_EQ(scene.dut().received(), sent);
  EXPECT_EQ(scene.events().delivered, 70u);
}

// PF-17: two extended frames equal in ID28..ID18, lost at each of ID17..ID0: identifier and data of
// the winner are right.
TEST(Pitfall, ExtendedLoserHasTheWinnersIdentifier) {
  for (unsigned bit = 0; bit < 18; ++bit) {
    for (const std::uint32_t pattern : {0x00000000u, 0x0003FFFFu, 0x00015A5Au, 0x0002A5A5u}) {
      const std::uint32_t id = 0x123u << 18 | pattern;
      const Frame winner = extended_frame(id & ~(1u << bit), {0xDE, 0xAD, 0xBE, 0xEF, 0x01});
      Scene scene;
      scene.send(extended_frame(id | 1u << bit, {0x55}));
      scene.play(wire(winner));
      EXPECT_EQ(scene.dut().received(), std::vector<Frame>{winner}) << bit;
    }
  }
}

// PF-18: a stuff bit in front of every bit of the identifier, of both levels: the identifier
// arrives as it was sent.
TEST(Pitfall, StuffBitAnywhereInTheIdentifierShiftsNothing) {
  for (unsigned start = 0; start + 5 <= 29; ++start) {
    const std::uint32_t run = 0x1Fu << (24 - start);
    for (const std::uint32_t id : {run, 0x1FFFFFFFu ^ run, 0x0AAAAAAAu | run, 0x15555555u & ~run}) {
      Scene scene;
      scene.expect_reception(extended_frame(id, {0x12}));
      scene.expect_transmission(extended_frame(id, {0x12}));
      scene.expect_reception(base_frame(id >> 18, {0xF8, 0x3E, 0x0F}));
    }
  }
}

// PF-18: and in front of every bit of the data.
TEST(Pitfall, StuffBitAnywhereInTheDataShiftsNothing) {
  for (unsigned start = 0; start + 5 <= 64; ++start) {
    Frame ones = base_frame(0x555, {0, 0, 0, 0, 0, 0, 0, 0});
    Frame zeros = base_frame(0x555, {0xAA, 0xAA, 0xAA, 0xAA, 0xAA, 0xAA, 0xAA, 0xAA});
    for (unsigned bit = start; bit < start + 5; ++bit) {
      ones.data[bit / 8] |= static_cast<std::uint8_t>(0x80u >> bit % 8);
      zeros.data[bit / 8] &= static_cast<std::uint8_t>(~(0x80u >> bit % 8));
    }
    Scene scene;
    scene.expect_reception(ones);
    scene.expect_reception(zeros);
    scene.expect_transmission(ones);
  }
}

// PF-19, MO-09: a one-shot frame that loses at its first, second or third bit is not repeated, and
// the failure is reported once.
TEST(Pitfall, OneShotFrameThatLosesEarlyIsNotRepeated) {
  for (unsigned bit = 0; bit < 3; ++bit) {
    CoreBench bench{1};
    bench.start();
    const Frame own = base_frame(0x7FF);
    const Frame winner = base_frame(0x7FFu ^ 0x400u >> bit, {0x77});
    bench.dut().request(own, true);
    bench.run_until([&] { return bench.place().field() == Field::kSof; }, 10);
    bench.lt(wire(winner));
    bench.run_bits(static_cast<unsigned>(wire(winner).size()));
    bench.clear_history();
    bench.run_bits(60);
    EXPECT_EQ(bench.tx_history(), r_bits(60));
    EXPECT_EQ(bench.dut().events().failed, 1u);
    EXPECT_EQ(bench.dut().received(), std::vector<Frame>{winner});
    EXPECT_FALSE(bench.dut().pending());
  }
}

// PF-20, IN-03: after an FD exception the eleven recessive bits count at once, no dominant bit
// needs to come first: eleven bits later a pending frame starts.
TEST(Pitfall, IntegrationAfterAnFdExceptionCountsAtOnce) {
  CoreConfig config = CoreBench::default_config();
  config.fd_tolerant = true;
  for (const bool extended : {false, true}) {
    Scene scene{kActive, config};
    const Frame fd = extended ? extended_frame(0x0AAAAAAA) : base_frame(0x2AA);
    const EncodeOptions options{.r0 = Level::kRecessive, .r1 = Level::kRecessive};
    const std::size_t fdf = offset_of(fd, extended ? Field::kR1 : Field::kR0, 0);
    scene.play(wire(fd, options).substr(0, fdf + 1));
    EXPECT_EQ(scene.field(), Field::kInteg);
    scene.request(kEight);
    EXPECT_EQ(scene.play(r_bits(11)), r_bits(11));
    EXPECT_EQ(scene.play(acknowledge(kEight)), wire(kEight));
  }
}

// PF-23, GV-3, GV-4: a stuff bit after CRC0: the CRC is still compared, the delimiter still
// checked, in both roles.
TEST(Pitfall, StuffBitAfterTheCrcDisturbsNeitherCrcNorDelimiter) {
  for (const Frame &frame : {base_frame(0x009), base_frame(0x017)}) {
    const std::string bits = wire(frame);
    const std::size_t delimiter = ack_offset(frame) - 1;
    Scene good;
    good.expect_reception(frame);
    good.expect_transmission(frame);
    Scene receiver;
    EXPECT_EQ(receiver.play(flipped(bits, delimiter).substr(0, delimiter + 1) + r_bits(6)),
              r_bits(delimiter + 1) + d_bits(6));
    EXPECT_EQ(receiver.events().errors, kErrForm);
    Scene sender;
    sender.send(frame);
    EXPECT_EQ(sender.play(r_bits(delimiter) + "0" + r_bits(6)),
              bits.substr(0, delimiter + 1) + d_bits(6));
    // A CRC whose first bit is wrong, with the last five as they were.
    Scene wrong;
    const std::string bad = wire_with_bad_crc(frame, 0x4000);
    EXPECT_EQ(wrong.play(bad), r_bits(bad.size() - 7) + d_bits(6) + "1");
    EXPECT_EQ(wrong.events().errors, kErrCrc);
  }
}

// PF-24, FF-03, FF-09: remote frames with any DLC: no data sent, none expected, none handed over.
TEST(Pitfall, RemoteFrameWithALengthHasNoData) {
  for (std::uint8_t dlc = 1; dlc < 16; ++dlc) {
    for (const bool extended : {false, true}) {
      const Frame remote = remote_frame(0x2C5, extended, dlc);
      Scene scene;
      scene.expect_reception(kEight);
      scene.expect_reception(remote);
      scene.expect_transmission(remote);
      scene.expect_transmission(kEight);
      EXPECT_EQ(wire(remote).size() - stuff_offsets(remote).size(), extended ? 64u : 44u);
    }
  }
}

// PF-25, FF-07, FF-08: DLC 9..15 are eight bytes in both roles.
TEST(Pitfall, LengthCodeAboveEightMeansEightBytes) {
  for (std::uint8_t dlc = 9; dlc < 16; ++dlc) {
    for (const bool extended : {false, true}) {
      Frame frame = kEight;
      frame.dlc = dlc;
      frame.extended = extended;
      EXPECT_EQ(wire(frame).size() - stuff_offsets(frame).size(), (extended ? 64u : 44u) + 64u);
      Scene scene;
      scene.expect_reception(frame);
      scene.expect_transmission(frame);
    }
  }
}

// PF-26, FC-06, FC-07, EF-06: each bit of the active flag seen recessive: a new flag from the next
// bit on, TEC or REC + 8.
TEST(Pitfall, BitErrorInTheActiveFlagCounts) {
  for (unsigned bit = 0; bit < 6; ++bit) {
    Scene sender;
    sender.send(kEight);
    sender.play(r_bits(14));
    sender.bench.force_next(0, Effect::kFlip);
    sender.play("1" + r_bits(bit));
    sender.bench.force_next(0, Effect::kRecessive);
    EXPECT_EQ(sender.play("1" + r_bits(6 + 2)), "0" + d_bits(6) + "11") << bit;
    sender.expect_counters(16, 0);
    Scene receiver;
    receiver.play(d_bits(6) + r_bits(bit));
    receiver.bench.force_next(0, Effect::kRecessive);
    EXPECT_EQ(receiver.play("1" + r_bits(6 + 2)), "0" + d_bits(6) + "11") << bit;
    receiver.expect_counters(0, 9);
  }
}

// PF-27, IN-01: ten recessive bits, a dominant one, ten again, a dominant one: not integrated; then
// eleven: integrated.
TEST(Pitfall, TenRecessiveBitsAreNotEleven) {
  CoreBench bench{1};
  bench.start();
  bench.dut().reset();
  bench.dut().start();
  bench.lt("0" + r_bits(10) + "0" + r_bits(10) + "0" + r_bits(10));
  bench.run_bits(33);
  EXPECT_FALSE(bench.dut().idle());
  EXPECT_FALSE(bench.dut().integrated());
  bench.run_bits(1);
  EXPECT_TRUE(bench.dut().idle());
  bench.lt(wire(kEight));
  bench.run_bits(150);
  EXPECT_EQ(bench.dut().received(), std::vector<Frame>{kEight});
}

// PF-28, ED-10: EOF7 dominant is a form error of the transmitter: flag, TEC + 8, retry.
TEST(Pitfall, TransmitterMindsADominantEof7) {
  for (const Counters &counters : kStates) {
    Scene scene{counters};
    scene.send(kEight);
    const std::string lt = acknowledge(kEight);
    EXPECT_EQ(scene.play(flipped(lt, lt.size() - 1)), wire(kEight));
    EXPECT_EQ(scene.play(r_bits(6)), flag_of(counters));
    scene.play(r_bits(8));
    scene.expect_counters(counters.tec + 8u, counters.rec);
    EXPECT_EQ(scene.events().sent, 0u);
    scene.run_to(Field::kSof);
    EXPECT_EQ(scene.play(lt), wire(kEight));
    EXPECT_EQ(scene.events().sent, 1u);
  }
}

// PF-28, ED-11, VA-01: for a receiver it is none: frame delivered, overload frame, counters stand.
TEST(Pitfall, ReceiverKeepsAFrameWithADominantEof7) {
  for (const Counters &counters : kStates) {
    Scene scene{counters};
    const std::string bits = wire(kEight);
    EXPECT_EQ(scene.play(flipped(bits, bits.size() - 1)), receiver_tx(bits));
    const unsigned rec = scene.rec();
    EXPECT_EQ(scene.play(r_bits(6 + 8)), d_bits(6) + r_bits(8));
    EXPECT_EQ(scene.dut().received(), std::vector<Frame>{kEight});
    EXPECT_EQ(scene.events().errors, 0);
    scene.expect_counters(counters.tec, rec);
  }
}

}  // namespace
}  // namespace vericansim
