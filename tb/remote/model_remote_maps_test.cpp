// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Map entries, on the model: RN-65, RN-66; with producers: RN-06, RN-64.
#include <memory>
#include <random>

#include "remote/model_node.hpp"
#include "remote/remote_entries.hpp"
#include "remote/window_copy.hpp"

namespace vericansim {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Node 3 in OPERATE; entries are written by user logic.
class RemoteModelMaps : public ::testing::Test {
 protected:
  RemoteModelMaps() {
    node.started();
    node.hear("000#01");
  }

  template <typename... Fields>
  void map(unsigned k, Fields... fields) {
    node.user_write(map_at(k), map_bytes(fields...));
  }

  ModelNode node{RemoteConfig::profile("full")};
};

// RN-65, the example: a copy of the window of node 5 at 200..277.
TEST_F(RemoteModelMaps, ACopyOfAWindow) {
  map(0, 0x680, 0x780, 0x200, 0);
  expect_a_copy_of_a_window([this](const Frame &frame) { node.model.receive(frame); },
                            [this](unsigned at, unsigned n) { return node.bytes(at, n); });
}

// RN-65: the fields of an entry at their borders.
TEST_F(RemoteModelMaps, WhatAnEntryTakes) {
  map(0, 0x6A0, 0x7FF, 0x300, 3);
  EXPECT_THAT(node.send("6A0#0102"), IsEmpty());
  EXPECT_THAT(node.bytes(0x300, 3), Each(0));
  (void)node.send("6A0#010203");
  EXPECT_THAT(node.bytes(0x300, 4), ElementsAre(1, 2, 3, 0));
  (void)node.send("6A0#0405060708090A0B");
  EXPECT_THAT(node.bytes(0x300, 4), ElementsAre(4, 5, 6, 0));
  (void)node.send("6A0#1112131415161718_9");
  (void)node.send("6A1#111213");
  (void)node.send("2A0#111213");
  (void)node.send("6A0#R3");
  (void)node.send("1A800000#111213");  // extended, the same first eleven bits
  EXPECT_THAT(node.bytes(0x300, 4), ElementsAre(4, 5, 6, 0));
  map(0, 0x2A0, 0x7FF, 0x300, 0);  // a request to node 5
  (void)node.send("2A0#212223242526");
  EXPECT_THAT(node.bytes(0x300, 7), ElementsAre(0x21, 0x22, 0x23, 0x24, 0x25, 0x26, 0));
  (void)node.send("2A0#");
  map(0, 0x0A0, 0x7FF, 0x320, 0);  // a request to all, this node too
  (void)node.send("0A0#31");
  EXPECT_EQ(node.bytes(0x320, 1)[0], 0);
  map(0, 0x2A0, 0x7FF, 0x300, 9);
  (void)node.send("2A0#4142434445464748");
  EXPECT_EQ(node.bytes(0x300, 1)[0], 0x21);
  EXPECT_EQ(node.model.status().refused, 0);
  EXPECT_EQ(node.model.status().accepted, 2);  // STATE, 0A0
}

// RN-65: the lowest entry wins, though a frame be too short for it; an entry that is off does not.
TEST_F(RemoteModelMaps, TheLowestEntryWins) {
  map(1, 0x6A0, 0x7F0, 0x310, 4);
  map(2, 0x6A0, 0x7FF, 0x320, 1);
  (void)node.send("6A0#01020304");
  EXPECT_THAT(node.bytes(0x310, 2), ElementsAre(1, 2));
  EXPECT_EQ(node.bytes(0x320, 1)[0], 0);
  (void)node.send("6A0#05");
  EXPECT_EQ(node.bytes(0x320, 1)[0], 0);
  (void)node.send("6A3#11121314");
  EXPECT_THAT(node.bytes(0x313, 2), ElementsAre(0x11, 0x12));
  node.user_write(0xF89, {0x06});  // entry 1 off
  (void)node.send("6A0#05");
  EXPECT_EQ(node.bytes(0x320, 1)[0], 5);
}

// RN-65: a port is taken only by an entry that compares all of A.
TEST_F(RemoteModelMaps, PortsNeedTheWholeA) {
  map(0, 0x6FE, 0x7FE, 0x300, 0);
  (void)node.send("6FE#01");
  EXPECT_EQ(node.bytes(0x300, 1)[0], 0);
  map(0, 0x6FE, 0x07F, 0x300, 0);  // STATUS of everybody
  (void)node.send("6FE#02");
  EXPECT_EQ(node.bytes(0x300, 1)[0], 2);
  (void)node.send("77E#03");
  EXPECT_EQ(node.bytes(0x300, 1)[0], 3);
}

// RN-65: checks and WP hold; nothing is counted.
TEST_F(RemoteModelMaps, ChecksOfMapEntries) {
  node.user_write(0xF08, {0x40, 0, 0, 0, 0});  // page 6: 300..37F
  for (const unsigned address : {0x300U, 0x2FFU, 0xDFFU, 0xE00U, 0xF10U, 0xFF0U, 0xFFFU, 0x1000U}) {
    map(0, 0x6A0, 0x7FF, address, 0);
    (void)node.send("6A0#0102");
  }
  EXPECT_THAT(node.bytes(0x2FF, 3), Each(0));
  EXPECT_THAT(node.bytes(0xDFF, 2), Each(0));
  EXPECT_THAT(node.bytes(0xF10, 2), Each(0));
  EXPECT_EQ(node.model.status().refused, 0);
  (void)node.send("000#02");
  node.unlock();
  map(0, 0x6A0, 0x7FF, 0xF18, 0);
  (void)node.send("6A0#0102");
  EXPECT_THAT(node.bytes(0xF18, 2), ElementsAre(1, 2));
}

// RN-65, bit 5: the frame acts as a TRIGGER, for what it has written itself, too.
TEST_F(RemoteModelMaps, AFrameThatTriggers) {
  map(0, 0x6A0, 0x7FF, 0x010, 0x20);
  node.hear("190#AABBCC");
  (void)node.model.take_pulses();
  (void)node.send("6A0#0102");
  EXPECT_THAT(node.bytes(0x10, 3), ElementsAre(1, 2, 0xCC));
  EXPECT_THAT(node.model.take_pulses(),
              ElementsAre(RemotePulse{false, 0x10, 2}, RemotePulse{true, 0, 0}));
  EXPECT_EQ(node.model.status().trigger, 1);
  (void)node.send("6A0#");
  EXPECT_THAT(node.model.take_pulses(), ElementsAre(RemotePulse{true, 0, 0}));
}

// RN-66: STALE after the time-out of an entry until its next frame; bit 6 leads to SAFE.
TEST_F(RemoteModelMaps, Stale) {
  map(0, 0x6A0, 0x7FF, 0x300, 2, 3);
  (void)node.wait(20);
  (void)node.send("6A0#0102");
  (void)node.wait(28);
  EXPECT_FALSE(node.model.status().stale);
  (void)node.wait(3);
  EXPECT_TRUE(node.model.status().stale);
  EXPECT_FALSE(node.model.safe());
  (void)node.send("6A0#01");  // too short
  EXPECT_TRUE(node.model.status().stale);
  EXPECT_THAT(node.send("1FE#R1"), ElementsAre("5FE#23"));
  (void)node.send("6A0#0102");
  EXPECT_FALSE(node.model.status().stale);
  map(1, 0x6B0, 0x7FF, 0x310, 0x42, 255);
  (void)node.wait(2549);
  EXPECT_FALSE(node.model.safe());
  (void)node.wait(3);
  EXPECT_TRUE(node.model.safe());
  (void)node.send("6B0#0102");
  (void)node.wait(2);
  EXPECT_TRUE(node.model.safe());  // it does not come back by itself
}

// RN-60, RN-66: RESTART begins the time-outs anew.
TEST_F(RemoteModelMaps, RestartBeginsTheTimeOutsAnew) {
  map(0, 0x6A0, 0x7FF, 0x300, 2, 3);
  (void)node.wait(20);
  (void)node.send("000#81");
  node.model.stopped();
  (void)node.wait(20);
  EXPECT_FALSE(node.model.status().stale);
  (void)node.wait(11);
  EXPECT_TRUE(node.model.status().stale);
}

// RN-66, RN-70: with AUTO_OP it does.
TEST_F(RemoteModelMaps, StaleWithAutoOperate) {
  ModelNode self{RemoteConfig::profile("full")};
  self.user_write(0xF01, {9});
  self.user_write(0xF80, {0xA0, 0x86, 0xFF, 0x07, 0, 3, 0x41, 2});
  self.model.start();
  EXPECT_FALSE(self.model.safe());
  (void)self.wait(21);
  EXPECT_TRUE(self.model.safe());
  (void)self.send("6A0#01");
  (void)self.wait(1);
  EXPECT_FALSE(self.model.safe());
}

// RN-63 to RN-65: five nodes that talk without a host; each has a copy of all windows.
TEST_F(RemoteModelMaps, FiveNodesWithoutAHost) {
  std::vector<std::unique_ptr<ModelNode>> nodes;
  for (unsigned number = 3; number <= 7; ++number) {
    nodes.push_back(std::make_unique<ModelNode>(RemoteConfig::profile("full"), number));
    ModelNode &one = *nodes.back();
    one.user_write(0xF01, {8});  // AUTO_OP
    for (unsigned k = 0; k < 4; ++k)
      one.user_write(0xF40 + 8 * k, {0x20 + 8 * k, 0x80 | 0x20 | 0x10 | 8, 50 + k, 0, k});
    for (unsigned other = 3; other <= 7; ++other) {
      const unsigned id = 0x8400 | other << 7;
      one.user_write(0xF80 + 8 * (other - 3), {id & 0xFF, id >> 8, 0x80, 0x07, 0, other, 0, 0});
    }
    one.model.start();
  }
  std::mt19937 dice{5};
  for (int ms = 0; ms < 10'000; ++ms) {
    nodes[dice() % 5]->user_write(0x20 + dice() % 0x20, {static_cast<unsigned>(dice() % 256)});
    for (auto &one : nodes) {
      one->model.tick();
      for (const std::string &text : one->drain())
        for (auto &other : nodes)
          if (other != one) other->hear(text);
    }
  }
  for (auto &one : nodes) (void)one->wait(5);  // nothing may be due any more but the cyclic ones
  for (const auto &one : nodes)
    for (const auto &other : nodes)
      if (one != other) {
        EXPECT_EQ(one->bytes(other->model.number() << 8 | 0x20, 0x20), other->bytes(0x20, 0x20));
      }
}

}  // namespace
}  // namespace vericansim
