// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 8: what is an error, what is not, and where its flag begins; both roles, all states.
#include <gtest/gtest.h>

#include <bit>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::kGv1Bits;
using model_bench::to_delimiter;
using model_bench::whole;

// 19 stuff bits (GV-7), and an extended frame with stuff bits of both levels in its arbitration
// field.
const Frame kManyStuffBits{
    .id = 0x078, .dlc = 8, .data = {0x01, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1}};
const Frame kExtended{.id = 0x1F07C1F0, .extended = true, .dlc = 2, .data = {0x00, 0xFF}};

bool in_arbitration(const WireBit &bit) {
  const bool extended_too = bit.field == Field::kExId || bit.field == Field::kExRtr;
  return bit.field == Field::kId || bit.field == Field::kRtr || extended_too;
}

class ErrorDetection : public ::testing::TestWithParam<Counters> {
 protected:
  [[nodiscard]] std::string flag() const { return flag_of(GetParam()); }
};

class PassiveErrorDetection : public ErrorDetection {};

INSTANTIATE_TEST_SUITE_P(States, ErrorDetection,
                         ::testing::Values(kActive, kPassive, kPassiveByRec));
INSTANTIATE_TEST_SUITE_P(States, PassiveErrorDetection, ::testing::Values(kPassive, kPassiveByRec));

// What happens to a transmitter that sees bit `n` of its frame inverted (first rows of 19.2a).
void invert_own_bit(const Counters &counters, const Frame &frame, std::size_t n) {
  const EncodedFrame wire = encode_frame(frame);
  const WireBit &bit = wire.bits[n];
  ErrorRig rig(counters);
  rig.send(frame);
  rig.play(rep(static_cast<int>(n), ".") + "!");
  SCOPED_TRACE(std::string{field_name(bit.field)} + " bit " + std::to_string(n));
  const bool recessive = bit.level == Level::kRecessive;
  const bool extended_ide = bit.field == Field::kIde && frame.extended;
  if (recessive && !bit.is_stuff && (in_arbitration(bit) || extended_ide)) {
    EXPECT_EQ(rig.last().errors, 0);
    EXPECT_TRUE(rig.last().failed);
    EXPECT_EQ(rig.tec(), counters.tec);
    EXPECT_EQ(rig.play("."), "1");  // a receiver now
    return;
  }
  const bool exempt = recessive && bit.is_stuff && in_arbitration(bit);
  const bool after_rtr = bit.field == Field::kR1 || (bit.field == Field::kIde && !frame.extended);
  const bool disputed = recessive && bit.is_stuff && after_rtr;  // FC-05b: 0 or 8
  if (exempt) {
    EXPECT_EQ(rig.last().errors, kErrStuff);
    EXPECT_EQ(rig.tec(), counters.tec);
  } else if (!disputed) {
    EXPECT_EQ(rig.last().errors, recessive ? kErrBit1 : kErrBit0);
    EXPECT_EQ(rig.tec(), counters.tec + 8u);
  }
  EXPECT_EQ(rig.rec(), counters.rec);
  EXPECT_EQ(rig.play(rep(6, ".")), flag_of(counters));
  // RO-04: SOF at n+18, or n+26 for who is passive by then (IF-11). No counter moves any more.
  const bool suspend = rig.tec() >= 128 || counters.rec >= 128;
  EXPECT_EQ(rig.play(rep(suspend ? 19 : 11, ".")), rep(suspend ? 19 : 11, "1"));
  EXPECT_EQ(rig.field(), Field::kSof);
}

// ED-01, ED-02, ED-08, AR-02, AR-03, AR-04, AR-05, FC-05, FC-05b, ED-13, RO-03, RO-04, MX-01,
// MX-02, MX-03, MX-04: every bit from SOF to CRC0, by the table 19.2a.
TEST_P(ErrorDetection, TransmitterChecksEveryBitOfItsFrame) {
  for (const Frame &frame : {kManyStuffBits, kExtended}) {
    const std::size_t length = encode_frame(frame).stuffed_length;
    for (std::size_t n = 0; n < length; ++n) invert_own_bit(GetParam(), frame, n);
  }
}

// ED-03, PF-35: dominant in the slot is what a transmitter waits for.
TEST_P(ErrorDetection, AcknowledgeIsNoBitError) {
  ErrorRig rig(GetParam());
  rig.transmit(kGv1);
  EXPECT_EQ(rig.sent(), 1u);
  EXPECT_EQ(rig.dut().events().errors, 0);
}

// ED-04, ED-18, EF-04: whatever comes during a passive flag is no error, of no kind.
TEST_P(PassiveErrorDetection, FlagDetectsNothing) {
  ErrorRig rig(GetParam());
  rig.send(kGv1);
  rig.play(rep(22, ".") + "!");
  rig.dut().clear_events();
  rig.play("0 1 00 111 0000 11111 0 1 00000 1 000000");
  EXPECT_EQ(rig.dut().events().errors, 0);
  EXPECT_EQ(rig.field(), Field::kWait);
  EXPECT_EQ(rig.tec(), GetParam().tec + 8u);
}

// ED-05, ED-12: delimiter wait, DEL8, intermission, suspend time and idle.
TEST_P(ErrorDetection, DominantBitsBetweenFramesAreNoErrors) {
  ErrorRig rig(GetParam());
  rig.send(kGv1);
  rig.play(rep(22, ".") + "!" + rep(6, "."));
  rig.dut().clear_events();
  rig.play("0000 1 111111 0");  // wait, DEL1..DEL7, DEL8
  EXPECT_EQ(rig.play("......"), kOverloadFlag);
  rig.play("000 1 1111111 0");  // INT1
  EXPECT_EQ(rig.play("......"), kOverloadFlag);
  rig.play("11111111 1 0");  // INT2
  EXPECT_EQ(rig.play("......"), kOverloadFlag);
  rig.play("11111111 11 0");  // INT3: a start of frame
  EXPECT_EQ(rig.dut().events().errors, 0);
  EXPECT_TRUE(rig.last().started);
}

// ED-06, ED-07, FC-02: a receiver checks its acknowledge; no REC-1, and the frame is dropped.
TEST_P(ErrorDetection, OwnAcknowledgeSeenRecessiveIsABitError) {
  ErrorRig rig(GetParam());
  rig.play(kGv1Bits + "1");
  EXPECT_EQ(rig.play("!"), "0");
  EXPECT_EQ(rig.last().errors, kErrBit0);
  rig.expect_rec(GetParam().rec, 1);
  EXPECT_EQ(rig.play(rep(6, ".")), flag());
  rig.play(rep(20, "."));
  EXPECT_EQ(rig.delivered(), 0u);
}

// ED-06: a receiver does not compare its recessive bits: the frame is full of dominant ones.
TEST_P(ErrorDetection, ReceiverIgnoresDominantBitsOfOthers) {
  ErrorRig rig(GetParam());
  rig.receive(kManyStuffBits);
  EXPECT_EQ(rig.dut().events().errors, 0);
  EXPECT_EQ(rig.delivered(), 1u);
}

// ED-08, ST-06: a receiver that sees a stuff bit inverted; a transmitter has one event, not two.
TEST_P(ErrorDetection, InvertedStuffBitIsOneStuffError) {
  const EncodedFrame wire = encode_frame(kManyStuffBits);
  const std::string levels = to_string(levels_of(wire.bits));
  unsigned tried = 0;
  for (std::size_t n = 0; n < wire.stuffed_length; ++n) {
    if (!wire.bits[n].is_stuff) continue;
    ++tried;
    ErrorRig rig(GetParam());
    rig.play(levels.substr(0, n) + (levels[n] == '0' ? "1" : "0"));
    EXPECT_EQ(rig.last().errors, kErrStuff) << n;
    rig.expect_rec(GetParam().rec, 1);
    EXPECT_EQ(rig.play(rep(6, ".")), flag()) << n;
  }
  EXPECT_EQ(tried, 19u);  // GV-7
}

// Bits from the CRC delimiter on, a dominant one at place `n` (0 = CRC delimiter); quiet otherwise.
std::string tail_with_dominant_at(unsigned n) {
  std::string tail = "1 0 1 1111111";
  tail = bits(tail);
  tail[n] = '0';
  return tail.substr(0, n + 1);
}

// ED-09, MX-09, MX-10: receiver; passive by REC alone turns active at the acknowledge (FC-12).
TEST_P(ErrorDetection, ReceiverSeesDominantInTheFixedBits) {
  for (const unsigned n : {0u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {  // CRC del., ACK del., EOF1..EOF6
    ErrorRig rig(GetParam());
    rig.play(kGv1Bits + tail_with_dominant_at(n));
    EXPECT_EQ(rig.last().errors, kErrForm) << n;
    const bool active = GetParam().tec < 128 && (n > 1 || !GetParam().passive());
    EXPECT_EQ(rig.play(rep(6, ".")), active ? "000000" : "111111") << n;
    rig.play(rep(12, "."));
    EXPECT_EQ(rig.delivered(), 0u) << n;
  }
}

// ED-09, ED-10, PF-28: transmitter, EOF7 included.
TEST_P(ErrorDetection, TransmitterSeesDominantInTheFixedBits) {
  for (const unsigned n : {0u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u}) {
    ErrorRig rig(GetParam());
    rig.send(kGv1);
    rig.play(rep(43, ".") + tail_with_dominant_at(n));
    EXPECT_EQ(rig.last().errors, kErrForm) << n;
    EXPECT_EQ(rig.tec(), GetParam().tec + 8u) << n;
    EXPECT_EQ(rig.play(rep(6, ".")), flag()) << n;
    EXPECT_EQ(rig.sent(), 0u) << n;
  }
}

// ED-09: DEL2..DEL7, for an error delimiter in both roles.
TEST_P(ErrorDetection, DominantInsideTheDelimiterIsAFormError) {
  for (int n = 2; n <= 7; ++n) {
    ErrorRig t(GetParam());
    t.send(kGv1);
    t.play(rep(22, ".") + "!" + rep(6, ".") + rep(n - 1, ".") + "0");
    EXPECT_EQ(t.last().errors, kErrForm) << n;
    EXPECT_EQ(t.tec(), GetParam().tec + 16u) << n;
    ErrorRig r(GetParam());
    r.play("000000" + rep(6, ".") + rep(n - 1, ".") + "0");
    EXPECT_EQ(r.last().errors, kErrForm) << n;
    r.expect_rec(GetParam().rec, 2);
    EXPECT_EQ(r.play(rep(6, ".")), r.last().passive ? "111111" : "000000") << n;
  }
}

// ED-11, VA-01: a receiver takes a dominant EOF7 as an overload condition.
TEST_P(ErrorDetection, DominantEof7IsNoErrorForAReceiver) {
  ErrorRig rig(GetParam());
  rig.play(kGv1Bits + "1 0 1 111111 0");
  EXPECT_EQ(rig.dut().events().errors, 0);
  EXPECT_EQ(rig.delivered(), 1u);
  EXPECT_EQ(rig.play(rep(6, ".")), kOverloadFlag);
}

// ED-13: the flag stands where the first identifier bit would.
TEST_P(ErrorDetection, OwnStartOfFrameSeenRecessiveIsABitError) {
  ErrorRig rig(GetParam());
  rig.send(kGv1);
  EXPECT_EQ(rig.play("!"), "0");
  EXPECT_EQ(rig.last().errors, kErrBit0);
  EXPECT_EQ(rig.tec(), GetParam().tec + 8u);
  EXPECT_EQ(rig.play(rep(6, ".")), flag());
}

// ED-14, ED-20, AK-02, CR-03: each CRC bit wrong in a way that breaks no stuff rule; flag at EOF1.
TEST_P(ErrorDetection, ReceiverSignalsACrcErrorFromEof1) {
  const Frame frame{.id = 0x2AA, .dlc = 1, .data = {0x55}};
  unsigned tried = 0;
  for (int n = 0; n < 15; ++n) {
    const EncodedFrame wire = encode_frame(frame);
    const std::string levels = to_string(levels_of(wire.bits));
    std::string bad = levels.substr(0, wire.stuffed_length);
    char &bit = bad[bad.size() - 1 - static_cast<std::size_t>(n)];
    bit = bit == '0' ? '1' : '0';
    const DecodeResult check = decode_frame(levels_from_string(bad + "1" + rep(10, "1")));
    if (check.error != DecodeError::kCrc) continue;  // the flip broke the stuffing instead
    ++tried;
    ErrorRig rig(GetParam());
    rig.play(bad + "1");
    EXPECT_EQ(rig.play("0"), "1") << n;
    EXPECT_EQ(rig.play("1"), "1") << n;
    EXPECT_EQ(rig.last().errors, kErrCrc) << n;
    EXPECT_EQ(rig.play(rep(6, ".")), flag()) << n;
    rig.expect_rec(GetParam().rec, 1);
  }
  EXPECT_GE(tried, 8u);
}

// ED-14: a transmitter has no CRC error; a wrong CRC bit is its bit error.
TEST_P(ErrorDetection, TransmitterHasBitErrorsInItsCrc) {
  for (unsigned n = 0; n < 15; ++n) {
    ErrorRig rig(GetParam());
    rig.send(kGv1);
    rig.run_to({.field = Field::kCrc, .index = n, .stuff = false});
    rig.play("!");
    EXPECT_EQ(rig.last().errors & ~(kErrBit0 | kErrBit1), 0) << n;
    EXPECT_NE(rig.last().errors, 0) << n;
    EXPECT_EQ(rig.play(rep(6, ".")), flag()) << n;
  }
}

// ED-15, ED-17, MX-31: one flag and one step, at the earlier of the two places.
TEST_P(ErrorDetection, CrcErrorWithAFormErrorIsOneError) {
  std::string bad = kGv1Bits;
  bad.back() = '0';
  ErrorRig early(GetParam());
  early.play(bad + "0");  // CRC delimiter
  EXPECT_EQ(early.last().errors, kErrForm);
  early.expect_rec(GetParam().rec, 1);
  EXPECT_EQ(early.play(rep(20, ".")), flag() + rep(14, "1"));
  early.expect_rec(GetParam().rec, 1);
  ErrorRig late(GetParam());
  late.play(bad + "1 0 0");  // ACK delimiter
  EXPECT_EQ(std::popcount(late.last().errors), 1);
  EXPECT_EQ(late.play(rep(20, ".")), flag() + rep(14, "1"));
  late.expect_rec(GetParam().rec, 1);
}

// ED-16, AK-03: the flag begins at the ACK delimiter.
TEST_P(ErrorDetection, MissingAcknowledgeIsAnErrorOfTheTransmitter) {
  ErrorRig rig(GetParam());
  rig.send(kGv1);
  rig.play(rep(45, "."));
  EXPECT_EQ(rig.last().errors, kErrAck);
  EXPECT_EQ(rig.play(rep(6, ".")), flag());
  EXPECT_EQ(rig.tec(), GetParam().tec + (GetParam().passive() ? 0u : 8u));
}

// ED-21, OV-05, MX-20, MX-21: errors of an overload frame are answered with an error frame.
TEST_P(ErrorDetection, ErrorsInAnOverloadFrameGiveAnErrorFrame) {
  for (int n = 1; n <= 6; ++n) {
    ErrorRig rig(GetParam());
    rig.receive(kGv1);
    const bool passive = rig.last().passive;  // the reception may have ended it (FC-12)
    const unsigned rec = rig.rec();
    rig.play("0" + rep(n - 1, ".") + "!");
    EXPECT_EQ(rig.last().errors, kErrBit0) << n;
    rig.expect_rec(rec, 8);
    EXPECT_EQ(rig.play(rep(6, ".")), passive ? "111111" : "000000") << n;
    EXPECT_EQ(rig.field(), Field::kWait) << n;
  }
  for (int n = 2; n <= 7; ++n) {
    ErrorRig rig(GetParam());
    rig.transmit(kGv1);
    const unsigned tec = rig.tec();
    const bool passive = rig.last().passive;
    rig.play("0" + rep(6, ".") + rep(n - 1, ".") + "0");
    EXPECT_EQ(rig.last().errors, kErrForm) << n;
    EXPECT_EQ(rig.tec(), tec + 8) << n;  // a transmitter still (RO-01)
    EXPECT_EQ(rig.play(rep(6, ".")), passive ? "111111" : "000000") << n;
  }
}

// ED-18, EF-08: the wait for the delimiter lasts as long as it must, without another flag.
TEST_P(ErrorDetection, WaitForTheDelimiterDetectsNothing) {
  ErrorRig rig(GetParam());
  rig.play("000000" + rep(6, GetParam().passive() ? "0" : "."));
  rig.dut().clear_events();
  EXPECT_EQ(rig.play(rep(100, "0")), rep(100, "1"));
  EXPECT_EQ(rig.dut().events().errors, 0);
}

// ED-19, IN-03, EF-13: noise during integration, in bus-off and while stopped.
TEST_P(ErrorDetection, NodesOffTheBusDetectNothing) {
  const std::string noise = "0 1 00000000 1 0 11 0000000 1 0 111111 0 1111111111 0";
  CoreBench stopped;
  stopped.dut().preset_counters(GetParam().tec, GetParam().rec);
  for (const char c : noise) stopped.clock(c == '0' ? Level::kDominant : Level::kRecessive);
  EXPECT_EQ(stopped.dut().events().errors, 0);
  stopped.dut().start();
  stopped.lt(noise);
  stopped.run_bits(50);
  EXPECT_EQ(stopped.dut().events().errors, 0);
  EXPECT_EQ(stopped.last().tec, GetParam().tec);
  EXPECT_EQ(stopped.last().rec, GetParam().rec);
  ErrorRig off({.tec = 248, .rec = GetParam().rec});
  off.send(kGv1);
  off.play("!");
  off.dut().clear_events();
  off.play(noise);
  EXPECT_EQ(off.dut().events().errors, 0);
  EXPECT_TRUE(off.last().bus_off);
}

}  // namespace
}  // namespace vericansim
