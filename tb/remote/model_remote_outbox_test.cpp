// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What waits to be sent, on the model: RN-15, RN-30, RN-54.

#include "remote/model_test.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;

class RemoteModelOutbox : public RemoteModelTest {};

// RN-54: a queue of TxDepth snapshots, in the order of the requests.
TEST_F(RemoteModelOutbox, AnswersAreSnapshotsInOrder) {
  (void)node.send("1A0#01");
  node.hear("1A0#R1");
  node.hear("1A0#02");
  node.hear("1F8#200001");
  node.hear("1A0#03");
  node.hear("1A0#R2");
  EXPECT_THAT(node.drain(), ElementsAre("5A0#01", "5F8#200002", "5A0#0300"));
  for (const unsigned depth : {1U, 4U}) {
    RemoteConfig config = full();
    config.tx_depth = depth;
    ModelNode other{config};
    other.started();
    for (unsigned i = 0; i < depth; ++i) other.hear("1A0#R1");
    EXPECT_EQ(other.model.status().refused, 0);
    other.hear("1A0#R1");
    EXPECT_EQ(other.last(), std::pair(6U, 0x20U));
    EXPECT_EQ(other.drain().size(), depth + 1);  // with STATUS
  }
}

/// The first millisecond is a step of LIFE; the next one is ten behind it.
class RemoteModelAnswerLife : public RemoteModelOutbox {
 protected:
  void ticks(unsigned n) {
    for (; n != 0; --n) node.model.tick();
  }
  void life(std::uint8_t steps) {
    node.user_write(remote_map::kLife, {steps});
    (void)node.send("1A0#R1");
  }
};

// RN-54: an answer lives LIFE steps of 10 ms, the first of which has begun before; what is dropped
// is counted; a STATUS waits for ever.
TEST_F(RemoteModelAnswerLife, OldAnswersAreDropped) {
  life(3);
  ticks(1);
  node.hear("1A0#R1");
  ticks(15);
  node.hear("1A0#R2");
  node.hear("1A0#");
  ticks(14);
  ASSERT_TRUE(node.model.wants());
  EXPECT_EQ(node.model.wants()->dlc, 1);
  EXPECT_EQ(node.bytes(0xFEB, 1)[0], 0);
  ticks(1);
  EXPECT_EQ(node.bytes(0xFEB, 1)[0], 1);
  ticks(9);
  EXPECT_EQ(node.bytes(0xFEB, 1)[0], 1);
  ticks(1);
  EXPECT_EQ(node.bytes(0xFEB, 1)[0], 2);
  EXPECT_THAT(node.drain(), ElementsAre(StartsWith("5FE#")));
}

// RN-54: 0 is no limit.
TEST_F(RemoteModelAnswerLife, NoLimit) {
  life(0);
  node.hear("1A0#R1");
  node.hear("002#0000000000000000");
  ticks(60'000);
  EXPECT_EQ(node.drain().size(), 2U);
}

// RN-54: LIFE holds from the answer after the next on; one behind an answer that lives longer waits
// for it.
TEST_F(RemoteModelAnswerLife, ChangedBetweenAnswers) {
  ticks(1);
  node.user_write(remote_map::kLife, {1});
  node.hear("1A0#R1");  // 100 ms
  node.hear("1A0#R2");  // 10 ms
  ticks(99);
  EXPECT_EQ(node.bytes(0xFEB, 1)[0], 0);
  ticks(1);
  EXPECT_EQ(node.bytes(0xFEB, 1)[0], 2);
  EXPECT_FALSE(node.model.wants());
}

// RN-54: a frame that is on its way is not dropped; it is asked again 10 ms later.
TEST_F(RemoteModelAnswerLife, WhatIsOnItsWayStays) {
  ticks(1);
  node.hear("1A0#R1");
  ticks(98);
  node.model.attempt();
  ticks(5);
  ASSERT_TRUE(node.model.wants());
  node.model.lost_arbitration();
  ticks(6);
  EXPECT_TRUE(node.model.wants());
  ticks(1);
  EXPECT_FALSE(node.model.wants());
}

// RN-15: RETRY attempts that end in an error, then the frame is dropped; a lost arbitration does
// not count, the next frame begins anew.
TEST_F(RemoteModelOutbox, RetryLimit) {
  const auto fail = [&](int n) {
    for (; n != 0; --n) {
      node.model.attempt();
      node.model.failed();
      node.model.attempt();
      node.model.lost_arbitration();
    }
  };
  node.hear("1A0#R1");
  node.hear("1A1#R2");
  fail(7);
  EXPECT_EQ(node.model.wants()->id, 0x5A0U);
  fail(1);
  EXPECT_EQ(node.model.wants()->id, 0x5A1U);
  EXPECT_EQ(node.bytes(0xFEB, 1)[0], 1);
  fail(7);
  EXPECT_EQ(node.model.wants()->id, 0x5A1U);
  EXPECT_THAT(node.drain(), ElementsAre("5A1#0000"));
  node.user_write(0xF07, {2});
  (void)node.send("1A0#");
  node.hear("1A0#");
  fail(2);
  EXPECT_FALSE(node.model.wants());
  // RN-26: a HERE that is taken back leaves none of its failures to what comes behind it.
  node.hear("002#0000000000000000");
  fail(1);
  node.hear("002#FFFFFFFFFFFFFFFF");
  node.hear("1A0#");
  fail(1);
  EXPECT_TRUE(node.model.wants());
  fail(1);
  EXPECT_FALSE(node.model.wants());
  node.user_write(0xF07, {0});
  (void)node.send("1A0#R1");
  node.hear("1A0#R1");
  fail(1000);
  EXPECT_TRUE(node.model.wants());
}

// What waits: the frame that was chosen first, then HERE, STATUS, the queue.
TEST_F(RemoteModelOutbox, OrderOfWhatWaits) {
  node.hear("1A0#R1");
  node.hear("1A1#R1");
  node.hear("1A0#");
  node.hear("002#0000000000000000");
  EXPECT_THAT(node.drain(), ElementsAre("5A0#00", "402#", "5FE#0200000320000100", "5A1#00"));
}

// STATUS after a result shows how things stand when it starts on the bus, then stays.
TEST_F(RemoteModelOutbox, StatusIsThatOfItsStart) {
  node.hear("1A0#");
  node.model.set_errors(8, 1);
  node.model.attempt();
  node.model.set_errors(16, 2);
  EXPECT_EQ(candump_frame(*node.model.wants()), "5FE#0208010320000100");
  node.model.lost_arbitration();
  EXPECT_EQ(candump_frame(*node.model.wants()), "5FE#0210020320000100");
}

}  // namespace
}  // namespace vericansim
