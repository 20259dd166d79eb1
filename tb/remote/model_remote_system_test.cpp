// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// System functions and SETUP, on the model: RN-26, RN-31, RN-60 to RN-62.
#include <memory>
#include <set>

#include "remote/model_test.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class RemoteModelSystem : public RemoteModelTest {
 protected:
  /// Code and A of the last request, and whether it was counted as refused.
  void expect_refused(const char *text, unsigned code) {
    const auto refused = node.model.status().refused;
    EXPECT_THAT(node.send(text), IsEmpty()) << text;
    EXPECT_EQ(node.model.status().refused, static_cast<std::uint8_t>(refused + 1)) << text;
    EXPECT_EQ(node.last().first, code) << text;
  }
};

// RN-31: illegal function and value of name 0 are counted by every node and answered by none.
TEST_F(RemoteModelSystem, SystemFunctionsThatAreWrong) {
  for (const char *text : {"005#01", "077#01", "07F#", "000#R1", "001#R1", "002#R8", "003#R1"})
    expect_refused(text, 1);
  for (const char *text : {"000#", "000#010300", "000#03", "000#00", "000#80", "001#0102", "002#",
                           "002#00000000000000", "003#", "003#0504", "004#00", "000#82"})
    expect_refused(text, 3);
  expect_refused("002#0000000000000000_9", 3);
  EXPECT_FALSE(node.model.selected());
}

// 3.3, RN-70: STATE for all, for one, for others.
TEST_F(RemoteModelSystem, StateForOneAndForAll) {
  EXPECT_THAT(node.send("000#0104"), IsEmpty());
  EXPECT_EQ(state(), kSafe);
  EXPECT_EQ(node.model.status().accepted, 0);
  (void)node.send("000#0103");
  EXPECT_EQ(state(), kOperate);
  EXPECT_FALSE(node.model.safe());
  (void)node.send("000#0204");
  EXPECT_EQ(state(), kOperate);
  (void)node.send("000#02");
  EXPECT_EQ(state(), kSafe);
  EXPECT_TRUE(node.model.safe());
  (void)node.send("000#0100");
  EXPECT_EQ(state(), kOperate);
  expect_refused("000#0503", 3);
  (void)node.send("000#0504");  // of another
  EXPECT_EQ(node.model.status().refused, 1);
}

// RN-61: entering OPERATE locks; leaving it does not open.
TEST_F(RemoteModelSystem, OperateLocks) {
  node.unlock();
  EXPECT_TRUE(node.model.status().unlocked);
  EXPECT_THAT(node.send("1F9#180F414243"), IsEmpty());
  EXPECT_THAT(node.bytes(0xF18, 3), ElementsAre(0x41, 0x42, 0x43));
  (void)node.send("000#01");
  EXPECT_FALSE(node.model.status().unlocked);
  (void)node.send("000#02");
  EXPECT_EQ(node.send("1F9#180F00").size(), 1U);
  EXPECT_EQ(node.last().first, 0x11U);
  node.unlock();
  EXPECT_THAT(node.send("1FC#02"), IsEmpty());
  EXPECT_FALSE(node.model.status().unlocked);
}

// 3.2, SETUP 3: no key opens it again before the reset.
TEST_F(RemoteModelSystem, LockUntilReset) {
  node.unlock();
  EXPECT_THAT(node.send("1FC#03"), IsEmpty());
  node.unlock();
  EXPECT_FALSE(node.model.status().unlocked);
  (void)node.send("000#81");
  node.model.stopped();
  node.unlock();
  EXPECT_FALSE(node.model.status().unlocked);
}

// RN-60: RESTART waits for the engine, keeps the memory, reads NODE and FLAGS again.
TEST_F(RemoteModelSystem, Restart) {
  (void)node.send("1A0#5A");
  node.unlock();
  (void)node.send("1F9#000F0602");  // number 6; ACKW alone
  EXPECT_EQ(node.model.number(), 3U);
  EXPECT_THAT(node.send("1A1#5B"), IsEmpty());
  node.hear("1A0#R1");
  node.hear("000#8103");
  EXPECT_TRUE(node.model.restarting());
  EXPECT_THAT(node.drain(), IsEmpty());
  EXPECT_THAT(node.send("1A0#R1"), IsEmpty());
  node.model.stopped();
  EXPECT_FALSE(node.model.restarting());
  EXPECT_EQ(state(), kSafe);
  EXPECT_EQ(node.model.number(), 6U);
  EXPECT_FALSE(node.model.status().unlocked);
  EXPECT_THAT(node.drain(), IsEmpty());  // BOOT is off, and the queue was emptied
  EXPECT_THAT(node.bytes(0x20, 2), ElementsAre(0x5A, 0x5B));
  EXPECT_THAT(node.send("320#5C"), ElementsAre("77E#0200000020060000"));
}

// RN-62, RN-26: ASSIGN does not touch the configuration.
TEST_F(RemoteModelSystem, AnAssignedNumberEndsWithRestart) {
  (void)node.send("002#0000000000000000");
  EXPECT_THAT(node.send("003#05"), ElementsAre("6FE#0200000003010000"));
  EXPECT_EQ(node.bytes(0xF00, 1)[0], 3);
  (void)node.send("000#81");
  node.model.stopped();
  EXPECT_EQ(node.model.number(), 3U);
}

// RN-26: 33 SELECT frames find a serial number among others, bit by bit.
TEST_F(RemoteModelSystem, SelectFindsASerialNumberBitByBit) {
  const std::uint32_t serials[] = {0xCAFE1234, 0xCAFE1235, 0x00000000, 0xFFFFFFFF, 0x4AFE1234};
  std::vector<std::unique_ptr<ModelNode>> nodes;
  for (const std::uint32_t serial : serials) {
    nodes.push_back(std::make_unique<ModelNode>(full(serial), 0));
    nodes.back()->started();
  }
  const auto here = [&](std::uint32_t value, std::uint32_t mask) {
    Frame frame;
    frame.id = 0x004;
    frame.dlc = 8;
    for (unsigned i = 0; i < 4; ++i) {
      frame.data[2 * i] = static_cast<std::uint8_t>(value >> (8 * i));
      frame.data[2 * i + 1] = static_cast<std::uint8_t>(mask >> (8 * i));
    }
    bool any = false;
    for (auto &one : nodes) {
      one->model.receive(frame);
      for (const std::string &text : one->drain()) {
        EXPECT_EQ(text, "402#");  // RN-12
        any = true;
      }
    }
    return any;
  };
  for (unsigned number = 2; number < 7; ++number) {
    std::uint32_t value = 0;
    std::uint32_t mask = 0;
    for (unsigned bit = 0; bit < 32; ++bit) {
      mask |= 1U << bit;
      if (!here(value, mask)) value |= 1U << bit;
    }
    EXPECT_TRUE(here(value, mask));
    Texts said;
    for (auto &one : nodes)
      for (std::string &text : one->send("003#0" + std::to_string(number))) said.push_back(text);
    EXPECT_EQ(said.size(), 1U);
  }
  EXPECT_FALSE(here(0, 0));  // SELECT NEW: none is left without a number
  std::set<unsigned> numbers;
  for (auto &one : nodes) numbers.insert(one->model.number());
  EXPECT_THAT(numbers, ElementsAre(2, 3, 4, 5, 6));
}

// 3.3: each byte of a serial number is compared under its mask; others are not selected.
TEST_F(RemoteModelSystem, SelectComparesUnderTheMask) {
  EXPECT_THAT(node.send("002#34FF12FFFEFFCAFF"), ElementsAre("402#"));
  for (const char *other : {"002#35FF12FFFEFFCAFF", "002#34FF92FFFEFFCAFF", "002#34FF12FFFFFFCAFF",
                            "002#34FF12FFFEFF4AFF"}) {
    EXPECT_THAT(node.send(other), IsEmpty());
    EXPECT_FALSE(node.model.selected()) << other;
  }
  EXPECT_THAT(node.send("002#35FE127FFE00CA00"), ElementsAre("402#"));
  EXPECT_THAT(node.send("004#0000000000000000"), IsEmpty());  // it has a number
  EXPECT_FALSE(node.model.selected());
  (void)node.send("003#05");
  EXPECT_EQ(node.model.number(), 3U);
  EXPECT_EQ(node.model.status().accepted, 0);
}

// RN-26: who is no longer selected does not say HERE any more.
TEST_F(RemoteModelSystem, ALaterSelectTakesHereBack) {
  node.hear("002#0000000000000000");
  node.hear("002#FFFF000000000000");
  EXPECT_THAT(node.drain(), IsEmpty());
}

// 3.3, ASSIGN: not in OPERATE; empties the queue; 0 and 1 are none.
TEST_F(RemoteModelSystem, Assign) {
  (void)node.send("002#0000000000000000");
  (void)node.send("000#01");
  expect_refused("003#05", 0x11);
  EXPECT_EQ(node.model.number(), 3U);
  (void)node.send("000#02");
  node.hear("1A0#R1");
  node.hear("1A0#");
  node.hear("003#05");
  EXPECT_THAT(node.drain(), ElementsAre("6FE#0200000003030200"));
  EXPECT_THAT(node.send("280#R1"), ElementsAre("680#00"));
  EXPECT_THAT(node.send("180#R1"), IsEmpty());
  for (const char *none : {"003#00", "003#01"}) {
    EXPECT_THAT(node.send(none), IsEmpty());
    EXPECT_THAT(node.send("0FE#R8"), IsEmpty());
  }
  EXPECT_THAT(node.send("003#0D"), ElementsAre("6FE#0200000003060200"));  // 13 modulo 8
}

}  // namespace
}  // namespace vericansim
