// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Block transfers, on the model: RN-40 to RN-43.
#include <fmt/format.h>

#include <numeric>

#include "remote/model_node.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Node 3 with bytes 0, 1, 2 .. (modulo 251) from address 400 on.
class RemoteModelBlocks : public ::testing::Test {
 protected:
  RemoteModelBlocks() {
    node.started();
    for (unsigned i = 0; i < 0x800; ++i) node.user_write(0x400 + i, {i % 251});
  }

  static std::string block(unsigned op, unsigned tag, unsigned address, unsigned count,
                           const char *gap = "") {
    return fmt::format("1FA#{:02X}{:02X}{:02X}{:02X}{:02X}{:02X}{}", op, tag, address & 0xFF,
                       address >> 8, count & 0xFF, count >> 8, gap);
  }
  static std::string data(unsigned seq, const std::vector<std::uint8_t> &bytes) {
    std::string text = fmt::format("1FB#{:02X}", seq & 0xFF);
    for (const unsigned byte : bytes) text += fmt::format("{:02X}", byte);
    return text;
  }
  static std::string closed(unsigned op, unsigned tag, unsigned code, unsigned done) {
    return fmt::format("5FA#{:02X}{:02X}{:02X}00{:02X}{:02X}", op, tag, code, done & 0xFF,
                       done >> 8);
  }
  void open_write(unsigned count) {
    EXPECT_THAT(node.send(block(2, 0x5B, 0x300, count)), ElementsAre(closed(2, 0x5B, 5, 0)));
  }

  ModelNode node{RemoteConfig::profile("full")};
};

// RN-40: every length; frames of 7 bytes, the last shorter, seq modulo 256, then the answer.
TEST_F(RemoteModelBlocks, ReadsOfEveryLength) {
  std::vector<unsigned> lengths(20);
  std::iota(lengths.begin(), lengths.end(), 1U);
  lengths.insert(lengths.end(), {255, 256, 1791, 1792, 1793, 2048});
  for (const unsigned length : lengths) {
    const Texts said = node.send(block(1, length & 0xFF, 0x400, length));
    ASSERT_EQ(said.size(), (length + 6) / 7 + 1) << length;
    EXPECT_EQ(said.back(), closed(1, length & 0xFF, 0, length));
    unsigned at = 0;
    for (unsigned seq = 0; seq + 1 < said.size(); ++seq) {
      const Frame frame = frame_of(said[seq]);
      ASSERT_EQ(frame.id, 0x5FBU);
      ASSERT_EQ(frame.data[0], seq & 0xFF);
      ASSERT_EQ(frame.dlc, std::min(length - at, 7U) + 1);
      for (unsigned i = 1; i < frame.dlc; ++i, ++at) ASSERT_EQ(frame.data[i], at % 251);
    }
    EXPECT_EQ(at, length);
  }
}

// RN-41: every length; bytes in the memory after each frame.
TEST_F(RemoteModelBlocks, WritesOfEveryLength) {
  for (unsigned length = 1; length <= 20; ++length) {
    open_write(length);
    for (unsigned done = 0; done < length; done += 7) {
      std::vector<std::uint8_t> bytes(std::min(length - done, 7U));
      std::iota(bytes.begin(), bytes.end(), static_cast<std::uint8_t>(length + done));
      const bool last = done + 7 >= length;
      EXPECT_EQ(node.send(data(done / 7, bytes)),
                last ? Texts{closed(2, 0x5B, 0, length)} : Texts{});
      EXPECT_EQ(node.bytes(0x300 + done, bytes.size()), bytes);
    }
  }
  EXPECT_EQ(node.bytes(0x314, 1)[0], 0);
}

// RN-41: seq goes on modulo 256.
TEST_F(RemoteModelBlocks, WriteOfTheWholeMemory) {
  EXPECT_EQ(node.send(block(2, 1, 0, 3584)).size(), 1U);
  for (unsigned done = 0; done < 3584; done += 7) {
    const Texts said = node.send(data(done / 7, std::vector<std::uint8_t>(7, 0xA5)));
    ASSERT_EQ(said.size(), done + 7 == 3584 ? 1U : 0U) << done;
  }
  EXPECT_THAT(node.bytes(0x18, 3584 - 0x18), ::testing::Each(0xA5));
}

// RN-41: a frame that is lost, or two that are swapped, close with 12 and the bytes done; one that
// comes twice is ignored.
TEST_F(RemoteModelBlocks, SequenceOfAWrite) {
  open_write(20);
  EXPECT_THAT(node.send(data(0, {1, 2, 3})), IsEmpty());
  const auto accepted = node.model.status().accepted;
  EXPECT_THAT(node.send(data(0, {7, 8, 9})), IsEmpty());
  EXPECT_EQ(node.model.status().accepted, accepted);
  EXPECT_THAT(node.bytes(0x300, 4), ElementsAre(1, 2, 3, 0));
  EXPECT_THAT(node.send(data(2, {4})), ElementsAre(closed(2, 0x5B, 0x12, 3)));
  EXPECT_EQ(node.last(), std::pair(0x12U, 0x7BU));
  EXPECT_EQ(node.send(data(1, {4})).size(), 1U);  // STATUS: none is open
  EXPECT_EQ(node.last(), std::pair(0x12U, 0x7BU));
  EXPECT_EQ(node.bytes(0xFEE, 1)[0], 2);
  open_write(20);
  EXPECT_THAT(node.send(data(0xFF, {4})), ElementsAre(closed(2, 0x5B, 0x12, 0)));
}

// RN-43: the first frame that is refused closes with its code.
TEST_F(RemoteModelBlocks, ChecksHoldForEachFrame) {
  struct Case {
    unsigned address;
    unsigned code;
    unsigned done;
  };
  node.user_write(0xF08, {0x20, 0, 0, 0, 0});  // page 5: 280..2FF
  node.user_write(0xF10, {0, 0x01, 0, 0, 0});  // page 8: 400..47F
  for (const auto &[address, code, done] :
       {Case{0xDF9, 2, 7}, Case{0x279, 0x10, 7}, Case{0xEF9, 2, 0}, Case{0xF00, 0x11, 0},
        Case{0xFF0, 0x10, 0}, Case{0x1000, 2, 0}, Case{0xFFFF, 2, 0}}) {
    EXPECT_THAT(node.send(block(2, 1, address, 14)), ElementsAre(closed(2, 1, 5, 0)));
    for (unsigned i = 0; i < done; i += 7)
      EXPECT_THAT(node.send(data(i / 7, {1, 2, 3, 4, 5, 6, 7})), IsEmpty());
    EXPECT_THAT(node.send(data(done / 7, {1, 2, 3, 4, 5, 6, 7})),
                ElementsAre(closed(2, 1, code, done)));
    EXPECT_EQ(node.last(), std::pair(code, 0x7BU));
  }
  EXPECT_THAT(node.send(block(1, 2, 0xDF9, 14)),
              ElementsAre("5FB#0001020304050607", closed(1, 2, 2, 7)));
  EXPECT_THAT(node.send(block(1, 2, 0x3F9, 14)),
              ElementsAre("5FB#0000000000000000", closed(1, 2, 0x10, 7)));
  EXPECT_THAT(node.send(block(1, 2, 0xE00, 14)), ElementsAre(closed(1, 2, 2, 0)));
}

// RN-43: lengths that DATA does not have, more bytes than are left.
TEST_F(RemoteModelBlocks, LengthsOfData) {
  for (const std::string &wrong :
       {std::string{"1FB#00"}, std::string{"1FB#"}, std::string{"1FB#0001020304050607_A"},
        data(0, {1, 2, 3, 4, 5, 6})}) {
    open_write(5);
    EXPECT_THAT(node.send(wrong), ElementsAre(closed(2, 0x5B, 3, 0))) << wrong;
  }
  open_write(5);
  EXPECT_EQ(node.send("1FB#R2").size(), 1U);  // STATUS; the write goes on
  EXPECT_EQ(node.last().first, 1U);
  EXPECT_THAT(node.send(data(0, {1, 2, 3, 4, 5})), ElementsAre(closed(2, 0x5B, 0, 5)));
}

// RN-42: one at a time, either way.
TEST_F(RemoteModelBlocks, OneAtATime) {
  for (const unsigned op : {1U, 2U}) {
    for (const unsigned second : {1U, 2U}) {
      ModelNode fresh{RemoteConfig::profile("full")};
      fresh.started();
      fresh.hear(block(op, 1, 0x300, 100));
      fresh.hear(block(second, 2, 0x300, 100));
      EXPECT_EQ(fresh.last(), std::pair(6U, 0x7AU));
      fresh.hear(block(0, 3, 0, 0));
      const Texts said = fresh.drain();
      EXPECT_EQ(std::count(said.begin(), said.end(), closed(op, 1, 0x14, op == 1 ? 7 : 0)), 1)
          << ::testing::PrintToString(said);
    }
  }
}

// RN-42: an abort ends what is open; twice is as once, and without a transfer it is nothing.
TEST_F(RemoteModelBlocks, Abort) {
  EXPECT_THAT(node.send(block(0, 9, 0, 0)), IsEmpty());
  open_write(20);
  EXPECT_THAT(node.send(data(0, {1, 2, 3})), IsEmpty());
  EXPECT_THAT(node.send(block(0, 9, 0, 0)), ElementsAre(closed(2, 0x5B, 0x14, 3)));
  EXPECT_EQ(node.last(), std::pair(0U, 0x7AU));
  EXPECT_THAT(node.send(block(0, 9, 0, 0)), IsEmpty());
  open_write(3);
}

// RN-42: BLKTO without DATA; each frame begins it anew; 0 is no limit; reads have none.
TEST_F(RemoteModelBlocks, TimeOut) {
  node.user_write(0xF06, {3});
  open_write(20);
  EXPECT_THAT(node.wait(28), IsEmpty());
  EXPECT_THAT(node.send(data(0, {1, 2, 3})), IsEmpty());
  EXPECT_THAT(node.wait(28), IsEmpty());
  EXPECT_THAT(node.wait(3), ElementsAre(closed(2, 0x5B, 0x13, 3)));
  EXPECT_EQ(node.last().first, 0U);  // no request was refused
  EXPECT_EQ(node.bytes(0xFEE, 1)[0], 1);
  node.user_write(0xF06, {0});
  open_write(20);
  EXPECT_THAT(node.wait(60'000), IsEmpty());
  ModelNode reset{RemoteConfig::profile("full")};
  reset.started();
  (void)reset.send(block(2, 1, 0x300, 9));
  EXPECT_THAT(reset.wait(498), IsEmpty());
  EXPECT_EQ(reset.wait(3).size(), 1U);
}

// RN-40: gap ms between the frames of a read.
TEST_F(RemoteModelBlocks, GapOfARead) {
  EXPECT_EQ(node.send(block(1, 1, 0x400, 21, "05")).size(), 1U);
  EXPECT_THAT(node.wait(4), IsEmpty());
  EXPECT_EQ(node.wait(1).size(), 1U);
  EXPECT_THAT(node.wait(4), IsEmpty());
  EXPECT_EQ(node.wait(1).size(), 2U);
  EXPECT_EQ(node.send(block(1, 1, 0x400, 21, "00")).size(), 4U);
}

// RN-40: requests in between are answered, after one frame of the transfer at most.
TEST_F(RemoteModelBlocks, OtherCommandsInBetween) {
  node.hear(block(1, 1, 0x400, 28));
  node.hear("1A0#R1");
  node.hear("1A0#R2");
  node.hear("1A0#5A");
  const Texts said = node.drain();
  ASSERT_EQ(said.size(), 7U);
  EXPECT_EQ(said[0], "5FB#0000010203040506");
  EXPECT_EQ(said[1], "5A0#00");
  EXPECT_EQ(said[2], "5A0#0000");
  EXPECT_EQ(said[3], "5FB#010708090A0B0C0D");
  open_write(9);
  EXPECT_THAT(node.send("1A0#R1"), ElementsAre("5A0#5A"));
  EXPECT_THAT(node.send(data(0, {1, 2, 3, 4, 5, 6, 7})), IsEmpty());
  EXPECT_EQ(node.send(block(1, 1, 0x400, 28)).size(), 1U);
  EXPECT_EQ(node.last().first, 6U);
  EXPECT_THAT(node.send(data(1, {8, 9})), ElementsAre(closed(2, 0x5B, 0, 9)));
}

// RN-42: an answer of BLOCK waits for room in the queue, and is not lost.
TEST_F(RemoteModelBlocks, TheAnswerWaitsForRoom) {
  open_write(2);
  for (int i = 0; i < 4; ++i) node.hear("1A0#R1");
  node.hear(data(0, {1, 2}));
  node.hear(block(2, 7, 0x300, 2));
  EXPECT_EQ(node.last().first, 6U);
  const Texts said = node.drain();
  EXPECT_EQ(said.back(), closed(2, 0x5B, 0, 2));
}

// RN-42, RN-70: bus-off and RESTART close without a word; ASSIGN as well.
TEST_F(RemoteModelBlocks, WhatElseEndsATransfer) {
  open_write(20);
  node.model.went_bus_off();
  node.model.recovered();
  (void)node.drain();
  open_write(20);
  (void)node.send("000#81");
  node.model.stopped();
  (void)node.drain();
  open_write(20);
  (void)node.send("002#0000000000000000");
  (void)node.send("003#03");
  open_write(20);
}

// RN-61: a block write to the configuration needs the key, and ends with OPERATE.
TEST_F(RemoteModelBlocks, ConfigurationByBlock) {
  node.unlock();
  EXPECT_EQ(node.send(block(2, 1, 0xF18, 8)).size(), 1U);
  EXPECT_THAT(node.send(data(0, {1, 2, 3, 4})), IsEmpty());
  EXPECT_THAT(node.bytes(0xF18, 4), ElementsAre(1, 2, 3, 4));
  (void)node.send("000#01");
  EXPECT_THAT(node.send(data(1, {5, 6, 7, 8})), ElementsAre(closed(2, 1, 0x11, 4)));
}

}  // namespace
}  // namespace vericansim
