// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// When a remote node does what: RN-21, RN-37, RN-44, RN-45, RN-52, RN-55, RN-60, RN-70, RN-72.
#include <gmock/gmock.h>

#include "bus/faults.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Time kClock = 125 * kNanosecond;

class RtlInstants : public ::testing::Test {
 protected:
  RtlInstants() {
    (void)bus.start();
    bus.bus.add(deaf);
    bus.node().on_pulse = [this](const RemotePulse &pulse) {
      pulses.push_back(pulse);
      shown.push_back(bus.bus.now());
    };
  }
  [[nodiscard]] Trace trace() { return decode_trace(bus.node().trace()); }
  void write_config(unsigned address, unsigned byte) {
    bus.node().user_write(address / 4, byte << 8 * (address % 4), 1U << address % 4);
  }

  /// The node does not hear its own answer to a request, until it is off the bus; when that is.
  Time bus_off() {
    bus.places.valid = 0;
    bus.host.request(frame_of("1A0#R1"));
    while (bus.places.valid == 0) bus.run_bits(1);
    const Time from = bus.bus.now() + 3 * UnitBus::kBit;
    deaf.add(2, Effect::kRecessive, {from, from + 2 * kMillisecond});
    EXPECT_TRUE(bus.bus.run_until([this] { return trace().bus_off; }, 2 * kMillisecond));
    return bus.bus.now();
  }

  RtlBus bus{std::vector<unsigned>{3}};
  ScheduledFaults deaf;
  std::vector<RemotePulse> pulses;
  std::vector<Time> shown;
};

// RN-45: the register that is written at the clock edge of the sample point of INT2 shows it.
TEST_F(RtlInstants, PulsesBeginInTheClockAfterInt2) {
  (void)bus.send("1A0#0102");
  ASSERT_EQ(pulses.size(), 1U);
  EXPECT_EQ(pulses[0], (RemotePulse{false, 0x20, 2}));
  EXPECT_EQ(shown[0], bus.places.int2);
  (void)bus.send("000#01");
  (void)bus.send("001#01");
  ASSERT_EQ(pulses.size(), 2U);
  EXPECT_TRUE(pulses[1].apply);
  EXPECT_EQ(shown[1], bus.places.int2);
}

// RN-36: a glitch behind the sample point of EOF5 makes that bit up to two clocks shorter (SY-05),
// while both bytes of the watchdog have to be counted: the frame is taken nevertheless. Wherever
// glitch and millisecond come.
TEST_F(RtlInstants, AShortBitBeforeEof6) {
  constexpr unsigned kAddress = 0x20;
  const std::string frame = "1A0#55";
  Time ms = 0;  // the last one of the node
  bus.node().on_ms = [&] { ms = bus.bus.now(); };
  bus.node().user_write(0xF00 / 4, 257U << 16, 0xC);  // WDT: its low byte is 0 then
  const auto start = [&] {
    bus.host.request(frame_of(frame));
    EXPECT_TRUE(
        bus.bus.run_until([&] { return bus.bus.level() == Level::kDominant; }, kMillisecond));
    return bus.bus.now();
  };
  const Time begin = start();
  (void)bus.settle();
  const Time length = bus.places.valid - begin;
  unsigned shorter = 0, lost = 0;
  for (int clocks = -32; clocks < 16; clocks += 4)
    for (int glitch = 7; glitch < 11; ++glitch) {
      const Time before = ms;
      ASSERT_TRUE(bus.bus.run_until([&] { return ms != before; }, 2 * kMillisecond));
      (void)bus.send("191#00");  // feeds the watchdog
      bus.node().user_write(kAddress / 4, 0, 1);
      bus.bus.run_until(ms + kMillisecond - length + clocks * kClock);
      const Time eof6 = start() + length;
      deaf.add(2, Effect::kDominant, {eof6 - glitch * kClock, eof6 - (glitch - 1) * kClock});
      bus.bus.run_until(eof6 + 12 * UnitBus::kBit);
      shorter += bus.places.valid == eof6 - 2 * kClock ? 1 : 0;
      lost += bus.places.valid <= eof6 && bus.node().peek(kAddress) != 0x55 ? 1 : 0;
      (void)bus.settle();
    }
  EXPECT_GT(shorter, 10U);
  EXPECT_EQ(lost, 0U);
}

// RN-71: STATE feeds the watchdog before its time is over, if both come within some clocks.
TEST_F(RtlInstants, StateFeedsTheWatchdogThatWouldEnd) {
  Time ms = 0;  // the last one of the node
  bus.node().on_ms = [&] { ms = bus.bus.now(); };
  bus.node().user_write(0xF00 / 4, 2U << 16, 0xC);  // WDT
  const auto wait_for_ms = [&] {
    const Time before = ms;
    EXPECT_TRUE(bus.bus.run_until([&] { return ms != before; }, 2 * kMillisecond));
  };
  bus.places.valid = 0;
  const Time begin = bus.bus.now();
  bus.host.request(frame_of("000#0103"));
  while (bus.places.valid == 0) bus.run_bits(1);
  const Time length = bus.places.valid - begin;
  unsigned ended = 0;
  for (int clocks = -8; clocks < 40; ++clocks) {
    (void)bus.send("000#0203");  // SAFE
    (void)bus.send("1FC#04");    // CLEAR
    wait_for_ms();
    (void)bus.send("191#00");  // feeds it
    wait_for_ms();
    bus.bus.run_until(ms + kMillisecond - length - clocks * kClock);
    bus.host.request(frame_of("000#0103"));
    bus.run_bits(200);
    const unsigned status = bus.node().peek(0xFF0);
    ended += (status & 0x43) != 3;
  }
  EXPECT_EQ(ended, 0U);
}

// RN-45: and the bytes are in the RAM before that, at 8 clocks a bit, whatever their number.
TEST_F(RtlInstants, BytesAreInTheRamBeforeInt2) {
  for (const char *frame : {"1A0#11", "1A3#1122334455667788", "1F9#0002112233445566"}) {
    SCOPED_TRACE(frame);
    const Frame sent = frame_of(frame);
    const bool far = (sent.id & 0x7F) == 0x79;
    const unsigned address = far ? 0x200 : sent.id & 0x7F;
    bus.node().user_write(address / 4, 0, 0xF);
    std::vector<std::uint8_t> seen;
    bus.node().on_pulse = [&](const RemotePulse &pulse) {
      for (unsigned i = 0; i < pulse.length; ++i) seen.push_back(bus.node().peek(address + i));
    };
    (void)bus.send(frame);
    const std::vector<std::uint8_t> wanted{sent.data.begin() + (far ? 2 : 0),
                                           sent.data.begin() + sent.dlc};
    EXPECT_EQ(seen, wanted);
  }
}

// RN-55: SOF five bits after EOF6 (EOF7, INT1 to INT3), at 8 clocks a bit; RN-21.
TEST_F(RtlInstants, TheAnswerFollowsTheIntermissionAtOnce) {
  for (const char *request : {"1A0#R1", "1A0#R8", "1F8#000206", "1FE#R8", "1FF#R8", "1A0#"}) {
    SCOPED_TRACE(request);
    bus.places.valid = bus.places.sof = 0;
    bus.host.request(frame_of(request));
    while (bus.places.valid == 0) bus.run_bits(1);
    const Time valid = bus.places.valid;
    bus.places.sof = 0;
    for (unsigned i = 0; i < 50 && bus.places.sof == 0; ++i) bus.run_bits(1);
    EXPECT_EQ(bus.places.sof - valid, 5 * UnitBus::kBit);
    (void)bus.settle();
  }
}

// RN-52: a hold delays the work; after 64 clocks it is ignored.
TEST_F(RtlInstants, HoldIsHonouredFor64Clocks) {
  bus.node().hold(true);
  (void)bus.send("1A0#5A");
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_GE(shown[0] - bus.places.valid, 64 * kClock);
  EXPECT_LE(shown[0] - bus.places.valid, (64 + 22) * kClock);
  EXPECT_EQ(bus.node().peek(0x20), 0x5A);
}

// RN-52: nothing becomes visible while user logic holds, and soon after it does.
TEST_F(RtlInstants, HoldThatEndsLetsGo) {
  bus.node().hold(true);
  bus.places.valid = 0;
  bus.host.request(frame_of("1A0#5A"));
  while (bus.places.valid == 0) bus.run_bits(1);
  bus.run_bits(4);
  EXPECT_THAT(shown, IsEmpty());
  EXPECT_EQ(bus.node().peek(0x20), 0);
  bus.node().hold(false);
  const Time released = bus.bus.now();
  (void)bus.settle();
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_LE(shown[0] - released, 22 * kClock);
}

// RN-60, RN-62: RESTART keeps the memory and reads the number again.
TEST_F(RtlInstants, RestartKeepsTheMemory) {
  (void)bus.send("1A0#5A");
  write_config(remote_map::kNode, 5);
  EXPECT_THAT(bus.send("000#8103"), ElementsAre("6FE#0200000000020000"));
  EXPECT_THAT(bus.send("2A0#R1"), ElementsAre("6A0#5A"));
  EXPECT_THAT(bus.send("1A0#R1"), IsEmpty());
}

// RN-60: a RESTART waits until nothing is under way: the frame that follows at once is not hurt.
TEST_F(RtlInstants, RestartDisturbsNoFrame) {
  bus.host.request(frame_of("000#8103"));
  bus.other.request(frame_of("7A0#0102"));
  EXPECT_THAT(bus.settle(), ElementsAre("7A0#0102", "5FE#0200000000010000"));
  EXPECT_EQ(decode_trace(bus.host.trace()).tec, 0);
  EXPECT_EQ(decode_trace(bus.other.trace()).tec, 0);
}

// RN-70, RN-71: the watchdog, from the last accepted request on, to the millisecond.
TEST_F(RtlInstants, WatchdogToTheMillisecond) {
  for (const unsigned ms : {1U, 2U, 10U, 255U, 256U, 300U}) {
    SCOPED_TRACE(ms);
    write_config(remote_map::kWatchdog, ms & 0xFF);
    write_config(remote_map::kWatchdog + 1, ms >> 8);
    bus.host.request(frame_of("1FC#04"));
    bus.host.request(frame_of("000#01"));
    bus.run_bits(150);
    ASSERT_EQ(bus.node().state(), RemoteState::kOperate);
    const Time fed = bus.places.valid;
    const auto safe = [&] { return bus.node().safe(); };
    ASSERT_TRUE(bus.bus.run_until(safe, (ms + 2) * kMillisecond));
    EXPECT_GE(bus.bus.now() - fed, (ms - 1) * kMillisecond - 20 * UnitBus::kBit);
    EXPECT_LE(bus.bus.now() - fed, (ms + 1) * kMillisecond);
    EXPECT_EQ(bus.node().peek(remote_map::kStatus) & 0x43, 0x42);
  }
}

// RN-72: nine times bus-off in a row; the back-off doubles each time, seven times at most, and is
// not shorter than that, but may be a step longer. STATUS tells of it, and the state is SAFE.
TEST_F(RtlInstants, BackOffDoublesWithEachBusOff) {
  write_config(remote_map::kBackOff, 2);
  write_config(remote_map::kRetry, 0);
  (void)bus.send("1A0#R1");  // RETRY holds from the next frame on
  for (unsigned n = 0; n < 9; ++n) {
    SCOPED_TRACE(n);
    (void)bus.send("000#01");
    const Time begin = bus_off();
    bus.run_bits(20);
    EXPECT_EQ(bus.node().state(), RemoteState::kSafe);
    ASSERT_TRUE(bus.bus.run_until([&] { return !trace().bus_off; }, 400 * kMillisecond));
    const Time step = (1 << std::min(n, 7U)) * kMillisecond;
    EXPECT_GE(bus.bus.now() - begin, 2 * step);
    EXPECT_LE(bus.bus.now() - begin, 3 * step + kMillisecond + 128 * 11 * UnitBus::kBit);
    const auto said = bus.settle();
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(said[0].substr(0, 6), "5FE#82");
  }
}

// RN-70: AUTO_OP acts after the start and after each recovery, unless STATE 02 or the watchdog has
// ended OPERATE, whose flag CLEAR takes away; STATE 01 mends that.
TEST_F(RtlInstants, AutoOpReturnsUnlessStateForbids) {
  const auto recovered = [this] {
    (void)bus_off();
    EXPECT_TRUE(bus.bus.run_until([this] { return !trace().bus_off; }, 400 * kMillisecond));
    (void)bus.settle();
    return bus.node().state();
  };
  write_config(remote_map::kBackOff, 1);
  write_config(remote_map::kRetry, 0);
  write_config(remote_map::kFlags, 0x0D);
  (void)bus.send("000#8103");
  EXPECT_EQ(bus.node().state(), RemoteState::kOperate) << "start";
  EXPECT_EQ(recovered(), RemoteState::kOperate) << "nothing forbids it";
  (void)bus.send("000#02");
  EXPECT_EQ(bus.node().state(), RemoteState::kSafe);
  EXPECT_EQ(recovered(), RemoteState::kSafe) << "STATE 02";
  (void)bus.send("000#01");
  EXPECT_EQ(recovered(), RemoteState::kOperate) << "STATE 01";
  write_config(remote_map::kWatchdog, 2);
  (void)bus.send("1A0#5A");
  bus.run_bits(5000);
  EXPECT_EQ(bus.node().state(), RemoteState::kSafe);
  write_config(remote_map::kWatchdog, 0);
  (void)bus.send("1FC#04");
  EXPECT_EQ(bus.node().peek(remote_map::kStatus) & 0x40, 0) << "CLEAR";
  EXPECT_EQ(recovered(), RemoteState::kSafe) << "watchdog";
}

/// All of the memory of a node of profile full, by BLOCK.
class RtlBlocks : public ::testing::Test {
 protected:
  static constexpr unsigned kSize = 3584, kPart = 7;  // bytes
  static constexpr unsigned kIdentity = 0x18;         // bytes at its begin that nobody writes
  static constexpr Time kBar = 72 * kMillisecond;

  RtlBlocks() { (void)bus.start(); }
  /// Many stuff bits, and no two frames with the same bytes.
  static std::uint8_t byte(unsigned at) {
    const unsigned part = at / kPart;
    return static_cast<std::uint8_t>(at % kPart == 0 ? part : at % kPart == 1 ? part >> 8 : 0x0F);
  }
  static Frame part(unsigned number) {
    Frame frame{0x1FB, false, false, 1 + kPart, {static_cast<std::uint8_t>(number)}};
    for (unsigned i = 0; i < kPart; ++i) frame.data[1 + i] = byte(number * kPart + i);
    return frame;
  }
  /// Until the node has said it.
  void wait_for(const std::string &answer) {
    const auto said = [&] {
      return !bus.host.received().empty() && candump_frame(bus.host.received().back()) == answer;
    };
    ASSERT_TRUE(bus.bus.run_until(said, 2 * kBar)) << answer;
  }

  /// Requests `frames`, each `pause` bits behind the end of EOF6 of the one before.
  void request(const std::vector<Frame> &frames, unsigned pause) {
    for (const Frame &frame : frames) {
      bus.places.valid = 0;
      bus.host.request(frame);
      ASSERT_TRUE(bus.bus.run_until([&] { return bus.places.valid != 0; }, kBar));
      bus.run_bits(pause);
    }
  }
  /// Writes two frames of seven bytes and one of `last` without waiting for BLOCK's answer,
  /// `between` behind BLOCK. All of it arrives, and the last answer says so.
  void write_at_once(unsigned last, unsigned pause, const std::vector<Frame> &between) {
    SCOPED_TRACE(::testing::Message() << "last " << last << ", pause " << pause);
    constexpr unsigned kAt = 0x100;
    const unsigned count = 2 * kPart + last, first = 0x100 * ++writes;  // part() has 8 bits of seq
    Frame block{0x1FA, false, false, 7, {2, 0xA1, 0, kAt >> 8, static_cast<std::uint8_t>(count)}};
    std::vector<Frame> frames{block};
    frames.insert(frames.end(), between.begin(), between.end());
    for (unsigned i = 0; i < 3; ++i) frames.push_back(part(first + i));
    frames.back().dlc = static_cast<std::uint8_t>(1 + last);
    bus.host.received().clear();
    request(frames, pause);
    Frame done{0x5FA, false, false, 6, {2, 0xA1, 0, 0, static_cast<std::uint8_t>(count)}};
    wait_for(candump_frame(done));
    for (unsigned i = 0; i < count; ++i)
      ASSERT_EQ(bus.node().peek(kAt + i), byte(first * kPart + i)) << "byte " << i;
  }

  RtlBus bus{rtl_unit(3, RemoteConfig::profile("full"))};
  unsigned writes = 0;
};

// RN-41: what DATA moves is counted by its own length, also if an answer waits meanwhile, which the
// node begins to send right behind DATA: it loses against DATA, wins, or has the bus alone.
TEST_F(RtlBlocks, DataBeforeTheAnswerOfBlock) {
  for (unsigned last = 1; last <= kPart; ++last)
    for (unsigned pause = 0; pause <= 8; ++pause)
      ASSERT_NO_FATAL_FAILURE(write_at_once(last, pause, {}));
}

// The same where answers of any length wait.
TEST_F(RtlBlocks, DataBeforeTheAnswerOfAnotherCommand) {
  for (unsigned length = 1; length <= 8; ++length)
    for (unsigned last = 1; last <= kPart; ++last) {
      SCOPED_TRACE(length);
      const Frame read = frame_of("1A0#R" + std::to_string(length));
      ASSERT_NO_FATAL_FAILURE(write_at_once(last, 0, {read}));
    }
}

// RN-44: written and read back, each within the bar from the request on.
TEST_F(RtlBlocks, AllOfTheMemoryInTime) {
  Time from = bus.bus.now();
  bus.host.request(frame_of("1FA#02A10000000E00"));
  wait_for("5FA#02A105000000");
  for (unsigned i = 0; i < kSize / kPart; ++i) bus.host.request(part(i));
  wait_for("5FA#02A10000000E");
  EXPECT_LE(bus.bus.now() - from, kBar);

  bus.host.received().clear();
  from = bus.bus.now();
  bus.host.request(frame_of("1FA#01A20000000E00"));
  wait_for("5FA#01A20000000E");
  EXPECT_LE(bus.bus.now() - from, kBar);
  ASSERT_EQ(bus.host.received().size(), kSize / kPart + 1);
  unsigned differences = 0;
  for (unsigned at = kIdentity; at < kSize; ++at)
    if (bus.host.received()[at / kPart].data[1 + at % kPart] != byte(at)) ++differences;
  EXPECT_EQ(differences, 0U);
}

}  // namespace
}  // namespace vericansim
