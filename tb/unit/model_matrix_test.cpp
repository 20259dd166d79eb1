// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Node model against the table of rule book 19.2a: each bit of a frame inverted once, the others
// quiet.
#include <gtest/gtest.h>

#include "unit/model_bench.hpp"

namespace vericansim {
namespace {

using namespace model_bench;  // NOLINT: the bench exists for these tests

/// Frames with stuff bits of both levels in every region, both formats, with and without data.
const std::vector<Frame> kFrames = {
    kGv1,
    {.id = 0x009},
    {.id = 0x017},
    {.id = 0x078, .dlc = 8, .data = {0x01, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1}},
    {.id = 0x010, .remote = true, .dlc = 15},
    {.id = 0x7FF, .dlc = 2, .data = {0xFF, 0xFF}},
    {.id = 0x00000000, .extended = true, .remote = true},
    {.id = 0x1FFFFFFF, .extended = true, .dlc = 1, .data = {0x00}},
    {.id = 0x0F83E0F8, .extended = true, .dlc = 3, .data = {0x1F, 0x07, 0xC1}},
};

bool plain_arbitration(const WireBit &bit, bool extended) {
  if (bit.is_stuff) return false;
  if (bit.field == Field::kId || bit.field == Field::kRtr) return true;
  return extended &&
         (bit.field == Field::kIde || bit.field == Field::kExId || bit.field == Field::kExRtr);
}

/// FC-05 exception 2 as this product reads FC-05b: up to and with the place of the base IDE or of
/// the extended RTR.
bool exempt_stuff(const WireBit &bit) {
  return bit.is_stuff && bit.level == Level::kRecessive && bit.field >= Field::kId &&
         bit.field <= Field::kExRtr;
}

/// Transmitter, bit `n` inverted: columns T/A and T/P.
void check_transmitter(const Frame &frame, const std::vector<WireBit> &bits, std::size_t n,
                       int tec) {
  NodeModel node = sender(frame, tec);
  for (std::size_t i = 0; i < n; ++i) {
    const bool slot = bits[i].field == Field::kAck;
    ASSERT_EQ(node.drive(), slot ? Level::kRecessive : bits[i].level);
    play(node, slot ? "0" : ".");
  }
  play(node, bits[n].field == Field::kAck ? "1" : "!");
  const bool recessive = bits[n].level == Level::kRecessive;
  if (recessive && plain_arbitration(bits[n], frame.extended)) {  // AR-02
    EXPECT_TRUE(node.events().lost_arbitration);
    EXPECT_EQ(node.role(), Role::kReceiver);
    EXPECT_EQ(node.tec(), tec);
    EXPECT_EQ(node.events().error, NodeError::kNone);
    return;
  }
  const bool passive = tec >= 128;
  const bool withheld = bits[n].field == Field::kAck && passive;
  EXPECT_EQ(node.tec(), tec + (withheld || exempt_stuff(bits[n]) ? 0 : 8));
  EXPECT_TRUE(node.events().tx_fail);
  EXPECT_EQ(node.rec(), 0);
  EXPECT_EQ(node.role(), Role::kTransmitter);
  const int gap = passive ? 25 : 17;  // RO-04
  EXPECT_EQ(play(node, rep(gap + 1, ".")), rep(6, passive ? "1" : "0") + rep(gap - 6, "1") + "0");
}

TEST(NodeModelMatrix, TransmitterWithAnyBitInverted) {  // MX-01..MX-05, RO-04
  for (const Frame &frame : kFrames) {
    const EncodedFrame encoded = encode_frame(frame);
    for (std::size_t n = 0; n < encoded.bits.size(); ++n) {
      for (const int tec : {0, 119, 128, 200}) {
        SCOPED_TRACE(testing::Message() << std::hex << frame.id << std::dec << " bit " << n << " "
                                        << field_name(encoded.bits[n].field) << " TEC " << tec);
        check_transmitter(frame, encoded.bits, n, tec);
      }
    }
  }
}

/// Receiver, bit `n` inverted, for the rows whose result the table gives.
void check_receiver(const std::vector<WireBit> &bits, std::size_t n, int tec, int rec) {
  NodeModel node = idle_node(tec, rec);
  std::string text = to_string(levels_of(bits));
  text[n] = text[n] == '0' ? '1' : '0';
  play(node, text.substr(0, n));
  const bool passive_before = node.error_state() == ErrorState::kPassive;
  play(node, text.substr(n, 1));
  const bool after_slot = bits[n].field == Field::kAckDel || bits[n].field == Field::kEof;
  const int set_back = rec > 127 ? 127 : std::max(rec - 1, 0);
  if (bits[n].field == Field::kEof && bits[n].index == 6) {  // ED-11
    EXPECT_TRUE(node.events().overload);
    EXPECT_EQ(node.rec(), set_back);
    EXPECT_EQ(play(node, rep(6, ".")), "000000");
    return;
  }
  EXPECT_NE(node.events().error, NodeError::kNone);
  if (after_slot) {
    EXPECT_EQ(node.rec(), set_back + 1);
  } else if (rec >= 128) {
    EXPECT_GE(node.rec(), 128);
  } else {
    EXPECT_EQ(node.rec(), rec + 1);
  }
  EXPECT_EQ(node.tec(), tec);
  EXPECT_EQ(passive_before, tec >= 128 || (rec >= 128 && !after_slot));  // FC-10a, MX-10
  EXPECT_EQ(play(node, rep(17, ".")), rep(6, passive_before ? "1" : "0") + rep(11, "1"));
  EXPECT_EQ(node.state().field, Field::kIdle);
}

TEST(NodeModelMatrix, ReceiverWithAStuffOrFixedBitInverted) {  // MX-07, MX-09..MX-11, RO-05
  for (const Frame &frame : kFrames) {
    const EncodedFrame encoded = encode_frame(frame);
    for (std::size_t n = 1; n < encoded.bits.size(); ++n) {
      if (!encoded.bits[n].is_stuff && encoded.bits[n].field < Field::kCrcDel) continue;
      for (const auto &[tec, rec] : {std::pair{0, 0}, {0, 5}, {0, 126}, {0, 128}, {200, 9}}) {
        SCOPED_TRACE(testing::Message()
                     << std::hex << frame.id << std::dec << " bit " << n << " "
                     << field_name(encoded.bits[n].field) << " " << tec << "/" << rec);
        check_receiver(encoded.bits, n, tec, rec);
      }
    }
  }
}

TEST(NodeModelMatrix, ReceiverNeverTakesAFrameWithOneFlip) {  // MX-06, MX-08
  for (const Frame &frame : kFrames) {
    const std::string good = whole(frame);
    for (std::size_t n = 0; n + 10 < good.size(); ++n) {
      NodeModel node = idle_node();
      std::string text = good;
      text[n] = text[n] == '0' ? '1' : '0';
      bool delivered = false;
      for (const char c : text + rep(30, "1")) {
        // The others go on with the frame, but this node's own flag is on the wire too.
        play(node, node.drive() == Level::kDominant ? "0" : std::string(1, c));
        delivered |= node.events().delivered;
      }
      EXPECT_FALSE(delivered) << std::hex << frame.id << std::dec << " bit " << n;
      play(node, good);  // RO-05: the next frame is whole
      EXPECT_EQ(node.received(), frame);
    }
  }
}

}  // namespace
}  // namespace vericansim
