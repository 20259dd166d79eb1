// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Abort and deactivation (flexcan.md 3.4, MO-10): at every clock of a frame, however it goes on,
// a request has exactly one end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "bus/faults.hpp"
#include "mailbox/tx_rig.hpp"

namespace vericansim {
namespace {

constexpr unsigned kMb = 10, kGrace = 700;  // clocks in which a frame that should not come would
constexpr unsigned kCodeInactive = 8, kCodeAborted = 9, kCodeData = 0xC;

const Frame kFrame{.id = 0x2A5, .dlc = 2, .data = {0x5A, 0xC3}};

// Nothing more happens to the buffer: one IFLAG, no further frame.
void expect_over(TxRig &rig, unsigned starts) {
  rig.clear_flag(0, kMb);
  rig.watch(kGrace);
  EXPECT_EQ(rig.flags(0), 0u) << "a second end";
  EXPECT_EQ(rig.starts(), starts) << "sent again";
}

// MO-10, FX-3.4.a, FX-3.4.c, FX-3.2.j: the buffer is written, `k` clocks later the abort request.
TEST(Abort, AtEveryClockOfAFrameThatSucceeds) {
  TxRig rig;
  rig.join();
  unsigned aborted = 0, sent = 0;
  for (unsigned k = 0; k < 560; ++k) {
    SCOPED_TRACE(k);
    rig.reset_counts();
    rig.put_tx(0, kMb, kFrame);
    rig.watch(k);
    rig.write_watched(reg::mb(kMb), kAbortWord);
    ASSERT_TRUE(rig.watch_flag(kMb, 1200));
    ASSERT_EQ(rig.starts(), rig.sent()) << "a frame on the wire runs on";
    ASSERT_EQ(rig.code(kMb), rig.sent() != 0 ? kCodeInactive : kCodeAborted);
    ++(rig.sent() != 0 ? sent : aborted);
    if (rig.sent() != 0) {
      EXPECT_EQ(mb_frame(rig.received()), kFrame);
    }
    expect_over(rig, rig.sent());
    ASSERT_FALSE(::testing::Test::HasFailure());
  }
  EXPECT_GT(aborted, 2u);
  EXPECT_GT(sent, 400u);
  EXPECT_FALSE(rig.violated());
}

// FX-3.4.a: the same around the clock in which the engine takes it from an idle bus, wherever in a
// bit it is written.
TEST(Abort, AtEveryClockAroundTheStart) {
  TxRig rig;
  rig.put(0, kMb, mb_words(kFrame, kCodeInactive));
  rig.join();
  unsigned aborted = 0, sent = 0;
  for (unsigned k = 0; k < 20; ++k) {
    for (unsigned phase = 0; phase < 8; ++phase) {
      SCOPED_TRACE(::testing::Message() << "after " << k << " clocks, phase " << phase);
      ASSERT_TRUE(rig.run_until([&] { return decode_trace(rig.node(0).trace()).sample; }, 20));
      rig.run(phase);
      rig.reset_counts();
      const std::uint32_t word = mb_words(kFrame, kCodeData).cs;
      rig.burst(0, {{.address = reg::mb(kMb), .write = true, .data = word},
                    {.address = reg::mb(kMb), .write = true, .data = kAbortWord, .pause = k}});
      ASSERT_TRUE(rig.watch_flag(kMb, 1200));
      const unsigned code = rig.code(kMb);
      ASSERT_TRUE(code == kCodeInactive || code == kCodeAborted);
      ++(code == kCodeInactive ? sent : aborted);
      rig.clear_flag(0, kMb);
      rig.watch(kGrace);
      ASSERT_EQ(rig.sent(), code == kCodeInactive ? 1u : 0u);
      ASSERT_EQ(rig.flags(0), 0u) << "a second end";
    }
  }
  EXPECT_GT(aborted, 10u);
  EXPECT_GT(sent, 10u);
}

// FX-3.4.a, FX-3.4.c: a request in the clock in which a better frame takes the place of the one
// that waits for the end of the intermission: it is for the buffer that it names.
TEST(Abort, AtEveryClockAroundAReplacement) {
  constexpr unsigned kBetter = kMb + 1;
  const Frame better{.id = 0x1A5, .dlc = 1, .data = {0x3C}};
  TxRig rig;
  rig.join();
  unsigned aborted = 0;
  for (unsigned wait = 36; wait < 72; ++wait) {
    for (unsigned distance = 0; distance < 14; ++distance) {
      SCOPED_TRACE(::testing::Message() << wait << " " << distance);
      rig.put(0, kBetter, mb_words(better, kCodeInactive));
      rig.put_tx(1, 30, {.id = 0});
      ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kDlc; }, 400));
      rig.put_tx(0, kMb, kFrame);
      ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kEof; }, 400));
      rig.run(wait);
      const std::uint32_t word = mb_words(better, kCodeData).cs;
      rig.burst(0,
                {{.address = reg::mb(kBetter), .write = true, .data = word},
                 {.address = reg::mb(kMb), .write = true, .data = kAbortWord, .pause = distance}});
      ASSERT_TRUE(rig.wait_flag(0, kBetter));
      ASSERT_TRUE(rig.wait_flag(0, kMb));
      ASSERT_EQ(rig.code(kBetter), kCodeInactive) << "nobody asked to abort it";
      ASSERT_THAT(rig.code(kMb), ::testing::AnyOf(kCodeInactive, kCodeAborted));
      aborted += rig.code(kMb) == kCodeAborted;
      rig.clear_flag(0, kBetter);
      rig.clear_flag(0, kMb);
      rig.clear_flag(1, 30);
      rig.run(30);
    }
  }
  EXPECT_GT(aborted, 36u * 14 / 2) << "all but those that came too late to be replaced";
}

// MO-10, FX-3.4.b, FX-9.e2656: nobody acknowledges, so each attempt fails; the request ends with
// the one under way.
TEST(Abort, AtEveryClockOfAFrameThatFails) {
  TxRig rig{1};
  rig.join();
  for (unsigned k = 0; k < 1100; ++k) {
    SCOPED_TRACE(k);
    rig.reset_counts();
    rig.put_tx(0, kMb, kFrame);
    rig.watch(k);
    rig.write_watched(reg::mb(kMb), kAbortWord);
    rig.watch(4);  // a frame taken in the very clock of the write
    const unsigned starts = rig.starts();
    const bool under_way = rig.starts() != rig.failed();
    ASSERT_TRUE(rig.watch_flag(kMb, 1200));
    ASSERT_EQ(rig.starts(), starts) << "tried again after the request";
    ASSERT_EQ(rig.failed(), rig.starts()) << "the attempt ends first";
    ASSERT_EQ(rig.sent(), 0u);
    ASSERT_EQ(rig.code(kMb), kCodeAborted);
    if (under_way) {
      ASSERT_GT(starts, 0u);
    }
    expect_over(rig, starts);
    ASSERT_FALSE(::testing::Test::HasFailure());
  }
}

// MO-10, FX-3.4.b: another node wins every arbitration.
TEST(Abort, AtEveryClockOfAFrameThatLosesArbitration) {
  TxRig rig;
  rig.join();
  rig.occupy(true);
  rig.watch(2000);
  unsigned waited = 0, under_way = 0;
  for (unsigned k = 0; k < 1200; k += 1) {
    SCOPED_TRACE(k);
    rig.reset_counts();
    const MbWords words = mb_words(kFrame, kCodeData);
    for (unsigned word : {2u, 3u, 1u, 0u})
      rig.write_watched(reg::mb(kMb, word), word == 0   ? words.cs
                                            : word == 1 ? words.id
                                            : word == 2 ? words.low
                                                        : words.high);
    rig.watch(k);
    const bool on_bus = rig.starts() != rig.failed();
    rig.write_watched(reg::mb(kMb), kAbortWord);
    rig.watch(4);
    const unsigned starts = rig.starts();
    ASSERT_TRUE(rig.watch_flag(kMb, 200)) << "the end of the attempt is enough";
    ++(on_bus ? under_way : waited);
    ASSERT_EQ(rig.starts(), starts);
    ASSERT_EQ(rig.failed(), starts);
    ASSERT_EQ(rig.code(kMb), kCodeAborted);
    rig.write_watched(reg::kIflag1, 1u << kMb);
    rig.watch(1);
  }
  EXPECT_GT(under_way, 10u);
  EXPECT_GT(waited, 100u);
  rig.watch(2500);
  EXPECT_EQ(rig.flags(0), 0u);
}

// FX-3.4.a: IFLAG of an abort that is done at once can be read in the second transfer behind it at
// the latest, however closely that follows.
TEST(Abort, DoneAtOnceIsToldAtOnce) {
  TxRig rig;
  rig.put(0, kMb, mb_words(kFrame, kCodeData));
  const auto results = rig.burst(0, {{.address = reg::mb(kMb), .write = true, .data = kAbortWord},
                                     {.address = reg::kIflag1},
                                     {.address = reg::kIflag1}});
  EXPECT_EQ(results[2].data, 1u << kMb);
}

// MO-10, FX-3.2.g: a request that comes while a remote frame is sent.
TEST(Abort, OfARemoteFrameThatSucceedsLeavesAnEmptyBuffer) {
  TxRig rig;
  rig.join();
  rig.put_tx(0, kMb, {.id = 0x123, .remote = true});
  ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kCrc; }, 2000));
  rig.write(0, reg::mb(kMb), kAbortWord);
  ASSERT_TRUE(rig.wait_flag(0, kMb));
  EXPECT_EQ(rig.code(kMb), 4u);
}

// FX-3.4.d, FX-3.3.j: what the CPU writes to a buffer that has moved out is dropped, until IFLAG is
// cleared.
TEST(Guard, WordsOfABufferThatIsBeingSentAndAfterwards) {
  TxRig rig;
  rig.join();
  const MbWords words = mb_words(kFrame, kCodeData);
  rig.put_tx(0, kMb, kFrame);
  ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kData; }, 2000));
  rig.write(0, reg::mb(kMb), kInactiveWord);
  EXPECT_EQ(rig.read(0, reg::mb(kMb)), words.cs);
  rig.access(0, {.address = reg::mb(kMb) + 3, .write = true, .size = AhbSize::kByte, .data = 0});
  rig.access(0, {.address = reg::mb(kMb) + 2, .write = true, .size = AhbSize::kByte, .data = 0});
  EXPECT_EQ(rig.read(0, reg::mb(kMb)), words.cs);
  ASSERT_TRUE(rig.wait_flag(0, kMb));
  for (unsigned word = 0; word < 4; ++word) rig.write(0, reg::mb(kMb, word), 0x0C0FFFFF);
  EXPECT_EQ(rig.code(kMb), kCodeInactive);
  EXPECT_EQ(rig.read(0, reg::mb(kMb, 1)), words.id);
  EXPECT_EQ(rig.read(0, reg::mb(kMb, 2)), words.low);
  EXPECT_EQ(rig.read(0, reg::mb(kMb, 3)), words.high);
  rig.write(0, reg::mb(kMb), kAbortWord);
  EXPECT_EQ(rig.code(kMb), kCodeInactive) << "an abort that comes too late changes nothing";
  // Back to back: the very next access after the clear is good.
  const auto clear = AhbTransfer{.address = reg::kIflag1, .write = true, .data = 1u << kMb};
  rig.burst(0, {clear, {.address = reg::mb(kMb), .write = true, .data = 0x08010000}});
  EXPECT_EQ(rig.read(0, reg::mb(kMb)), 0x08010000u);
  rig.watch(20);
  EXPECT_EQ(rig.flags(0), 0u);
}

TEST(Guard, FlagsOfReceptionBlockNothing) {  // FX-3.3.j: only after a transmission
  TxRig rig;
  rig.put_rx(0, 5, {.id = 0x77});
  rig.join();
  rig.put_tx(1, 8, {.id = 0x77});
  ASSERT_TRUE(rig.wait_flag(0, 5));
  rig.write(0, reg::mb(5), 0);
  EXPECT_EQ(rig.read(0, reg::mb(5)), 0u);
  rig.write(0, reg::mb(5, 2), 0x12345678);
  EXPECT_EQ(rig.read(0, reg::mb(5, 2)), 0x12345678u);
}

TEST(Guard, NothingIsBlockedWithoutAen) {  // FX-MCR.AEN, FX-3.3.i, FX-3.2.k
  TxRig rig{2, RigConfig{}};
  rig.join();
  rig.put_tx(0, kMb, kFrame);
  ASSERT_TRUE(rig.wait_flag(0, kMb));
  rig.write(0, reg::mb(kMb), 0x08030000);
  EXPECT_EQ(rig.read(0, reg::mb(kMb)), 0x08030000u);
  rig.write(0, reg::mb(kMb), kAbortWord);
  rig.clear_flag(0, kMb);
  rig.run(50);
  EXPECT_EQ(rig.flags(0), 0u) << "1001 is no request then";
}

// FX-3.4.a: buffers that wait are aborted at once, one after the other in consecutive clocks.
TEST(Abort, ManyWaitingBuffersBackToBack) {
  TxRig rig;
  for (unsigned mb = 0; mb < 64; ++mb) rig.put_tx(0, mb, {.id = 0x100 + mb});
  std::vector<AhbTransfer> aborts;
  for (unsigned mb = 0; mb < 64; ++mb)
    aborts.push_back({.address = reg::mb(mb), .write = true, .data = kAbortWord});
  rig.join();
  rig.burst(0, aborts);
  const auto done = [&] { return rig.flags(0) == ~0ull; };
  EXPECT_TRUE(rig.run_until(done, 700));
  unsigned sent = 0;
  for (unsigned mb = 0; mb < 64; ++mb) sent += rig.code(mb) == kCodeInactive;
  EXPECT_LE(sent, 1u);
  for (unsigned mb = 0; mb < 64; ++mb)
    EXPECT_TRUE(rig.code(mb) == kCodeInactive || rig.code(mb) == kCodeAborted) << mb;
  rig.reset_counts();
  rig.watch(kGrace);
  EXPECT_EQ(rig.starts(), 0u);
}

// FX-3.4.a, FX-3.4.b: freeze takes a frame back that has not begun; its buffer stays active, or is
// aborted.
TEST(Abort, InFreezeMode) {
  TxRig rig;
  rig.join();
  rig.put_tx(0, kMb, kFrame);
  rig.put_tx(0, kMb + 1, kFrame);
  ASSERT_TRUE(rig.freeze(0));
  rig.clear_flag(0, kMb);
  rig.reset_counts();
  const unsigned first = rig.code(kMb) == kCodeData ? kMb : kMb + 1;
  EXPECT_EQ(rig.code(kMb + 1), kCodeData);
  for (unsigned mb = first; mb <= kMb + 1; ++mb) {
    rig.write(0, reg::mb(mb), kAbortWord);
    EXPECT_EQ(rig.code(mb), kCodeAborted);
    EXPECT_EQ((rig.flags(0) >> mb) & 1, 1u);
  }
  rig.go(0);
  rig.watch(kGrace);
  EXPECT_EQ(rig.starts(), 0u);
}

// FX-3.4.b: request and freeze at every distance; alone, so that no attempt succeeds.
TEST(Abort, FreezeWhileARequestIsPending) {
  TxRig rig{1};
  rig.join();
  for (unsigned k = 0; k < 500; k += 3) {
    SCOPED_TRACE(k);
    rig.put_tx(0, kMb, kFrame);
    rig.run(k);
    const std::uint32_t mcr = rig.read(0, reg::kMcr);
    rig.burst(0,
              {{.address = reg::mb(kMb), .write = true, .data = kAbortWord},
               {.address = reg::kMcr, .write = true, .data = mcr | reg::kMcrFrz | reg::kMcrHalt}});
    const auto frozen = [&] { return (rig.read(0, reg::kMcr) & reg::kMcrFrzAck) != 0; };
    ASSERT_TRUE(rig.run_until(frozen, 4000));
    ASSERT_EQ(rig.code(kMb), kCodeAborted);
    ASSERT_EQ(rig.flags(0), 1ull << kMb) << "before the acknowledge";
    rig.clear_flag(0, kMb);
    rig.write(0, reg::kEcr, 0);
    rig.go(0);
  }
}

// FX-2.3.b, FX-3.4.b: a soft reset ends the frame on the bus and with it the request. What is left
// of that is over when the flags are cleared, also where the CPU's reads take every second slot.
TEST(Abort, SoftResetWhileARequestIsPending) {
  TxRig rig;
  rig.hammer(0, [] { return AhbTransfer{.address = reg::mb(20, 2)}; });
  rig.join();
  unsigned under_way = 0;
  for (unsigned k = 0; k < 400; ++k) {
    SCOPED_TRACE(k);
    rig.put_tx(0, kMb, kFrame);
    rig.run(k);
    rig.write(0, reg::mb(kMb), kAbortWord);
    under_way += rig.field(0) >= Field::kSof;
    rig.write(0, reg::kMcr, reg::kMcrSoftRst);
    const auto over = [&] { return (rig.read(0, reg::kMcr) & reg::kMcrSoftRst) == 0; };
    ASSERT_TRUE(rig.run_until(over, 200));
    rig.run(20);
    ASSERT_EQ(rig.flags(0), 0u) << "set behind the reset";
    rig.write(0, reg::mb(kMb), kInactiveWord);
    rig.configure(0, TxRig::with_aen());
    rig.go(0);
    rig.run(200);
  }
  EXPECT_GT(under_way, 300u);
}

// flexcan.md 2.8, 3.4: in bus-off buffers stay active, abort requests and deactivation are obeyed.
TEST(Abort, InBusOff) {
  TxRig rig;
  LevelFault fault{0, Effect::kDominant, {2 * kMillisecond, 2 * kMillisecond + 40 * kMicrosecond}};
  rig.bus().add(fault);
  rig.write(0, reg::kEcr, 0xF8);
  rig.write(0, reg::kCtrl, kTiming8 | reg::kCtrlBoffRec);
  rig.join();
  rig.run_until([&] { return rig.bus().now() >= 2 * kMillisecond - 20 * kMicrosecond; }, 20000);
  for (unsigned mb : {kMb, kMb + 1, kMb + 2}) rig.put_tx(0, mb, {.id = 0x7FF, .dlc = 8});
  const auto bus_off = [&] { return (rig.read(0, reg::kEsr) & 0x20) != 0; };
  ASSERT_TRUE(rig.run_until(bus_off, 2000));
  rig.run(200);
  EXPECT_EQ(rig.flags(0), 0u);
  for (unsigned mb : {kMb, kMb + 1, kMb + 2}) EXPECT_EQ(rig.code(mb), kCodeData);
  rig.write(0, reg::mb(kMb), kAbortWord);
  rig.run(10);
  EXPECT_EQ(rig.code(kMb), kCodeAborted);
  EXPECT_EQ(rig.flags(0), 1ull << kMb);
  rig.write(0, reg::mb(kMb + 1), kInactiveWord);
  EXPECT_EQ(rig.code(kMb + 1), kCodeInactive);
  // Recovery: what is still active goes out.
  rig.write(0, reg::kCtrl, kTiming8);
  rig.reset_counts();
  rig.watch(128 * 11 * 8 + 2500);
  EXPECT_EQ(rig.sent(), 1u);
  EXPECT_EQ(rig.flags(0), (1ull << kMb) | (1ull << (kMb + 2)));
}

// FX-3.4.f, FX-9.ERR006032: deactivation with AEN = 0 at every clock; then the words are cleared,
// as drivers do. What is on the wire stays whole and leaves no trace in the buffer.
TEST(Deactivate, AtEveryClockOfAFrame) {
  TxRig rig{2, RigConfig{}};
  rig.join();
  unsigned stopped = 0;
  for (unsigned k = 0; k < 560; ++k) {
    SCOPED_TRACE(k);
    rig.reset_counts();
    rig.put_tx(0, kMb, kFrame);
    rig.watch(k);
    const bool over = rig.sent() != 0;
    rig.write_watched(reg::mb(kMb), kInactiveWord);
    for (unsigned word : {1u, 2u, 3u}) rig.write_watched(reg::mb(kMb, word), 0);
    rig.watch(kGrace);
    ASSERT_LE(rig.starts(), 1u);
    ASSERT_EQ(rig.sent(), rig.starts());
    if (rig.sent() != 0) {
      ASSERT_EQ(mb_frame(rig.received()), kFrame);
    } else {
      ++stopped;
    }
    ASSERT_EQ(rig.read(0, reg::mb(kMb)), kInactiveWord);
    if (!over) {
      ASSERT_EQ(rig.flags(0), 0u) << "no IFLAG for a frame taken back";
    }
    rig.clear_flag(0, kMb);
  }
  EXPECT_GT(stopped, 2u);
}

// FX-9.ERR005829, FX-3.3.g: the drivers' workaround writes, in every clock around the start of a
// frame.
// FX-3.4.a, FX-3.4.g: software replaces a waiting frame by a new one, with C/S writes of code 1100
// alone, while another frame is on the bus. What is sent is the last one, once, with its IFLAG,
// whenever the writes come and however often.
TEST(Replace, OnlyTheLastFrameIsSent) {
  constexpr unsigned kReplaced = 5, kPeer = 30;
  for (const bool aen : {false, true}) {
    for (unsigned times = 1; times < 5; ++times) {
      for (unsigned pause = 40; pause < 160; pause += 7) {
        TxRig rig{2, aen ? TxRig::with_aen() : RigConfig{}};
        rig.join();
        rig.put_tx(1, kPeer, {.id = 0, .dlc = 8});
        ASSERT_TRUE(rig.run_until([&] { return rig.field(0) == Field::kId; }, 400));
        std::uint32_t id = 0x100;
        for (unsigned i = 0; i < times; ++i, ++id) {
          const MbWords words = mb_words({.id = id, .dlc = 1, .data = {1}}, 0xC);
          rig.write_watched(reg::mb(kReplaced, 2), words.low);
          rig.write_watched(reg::mb(kReplaced, 1), words.id);
          rig.write_watched(reg::mb(kReplaced), words.cs);
          rig.watch(pause);
        }
        ASSERT_NE(rig.field(0), Field::kInt) << "all was written within the other frame";
        ASSERT_TRUE(rig.watch_flag(kReplaced, 2000));
        rig.watch(500);
        EXPECT_EQ(rig.starts(), 1u) << "AEN " << aen << ", " << times << " times, " << pause;
        EXPECT_EQ(mb_frame(rig.received()).id, id - 1);
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(Deactivate, WritesToOtherBuffersDelayNothing) {
  for (unsigned lbuf : {0u, 1u}) {
    RigConfig config;
    config.ctrl |= lbuf != 0 ? reg::kCtrlLbuf : 0;
    TxRig rig{2, config};
    rig.join();
    for (unsigned k = 0; k < 30; ++k) {
      SCOPED_TRACE(k);
      rig.reset_counts();
      rig.put_tx(0, kMb, kFrame);
      rig.watch(k);
      for (unsigned mb : {0u, 8u, 0u, 8u}) rig.write_watched(reg::mb(mb), kInactiveWord);
      rig.watch(8 * 9);  // nine bit times after the C/S write at the latest
      ASSERT_EQ(rig.starts(), 1u);
      ASSERT_TRUE(rig.watch_flag(kMb, 1000));
      rig.clear_flag(0, kMb);
      rig.watch(40);
    }
  }
}

}  // namespace
}  // namespace vericansim
