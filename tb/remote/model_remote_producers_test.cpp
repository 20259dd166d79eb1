// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Producers, on the model: RN-06, RN-63, RN-64.
#include <stdexcept>

#include "remote/model_node.hpp"
#include "remote/remote_entries.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using mode::kChange;
using mode::kCyclic;
using mode::kOn;
using mode::kTriggers;

/// Node 3 in OPERATE; entries are written by user logic.
class RemoteModelProducers : public ::testing::Test {
 protected:
  RemoteModelProducers() {
    node.started();
    node.hear("000#01");
  }

  template <typename... Fields>
  void produce(unsigned k, Fields... fields) {
    node.user_write(producer_at(k), producer_bytes(fields...));
  }
  ModelNode node{RemoteConfig::profile("full")};
};

// RN-63: cyclic, every period, to the tick.
TEST_F(RemoteModelProducers, CyclicByTime) {
  node.user_write(0x30, {1, 2, 3});
  produce(0, 0x30, kOn | kCyclic | 3, 5);
  EXPECT_THAT(node.wait(4), IsEmpty());
  for (int i = 0; i < 5; ++i) {
    EXPECT_THAT(node.wait(1), ElementsAre("5B0#010203"));
    EXPECT_THAT(node.wait(4), IsEmpty());
  }
  produce(0, 0x30, kOn | kCyclic | 1, 300);
  EXPECT_THAT(node.wait(1), SizeIs(1));  // what is left of the period before
  EXPECT_THAT(node.wait(299), IsEmpty());
  EXPECT_THAT(node.wait(2701), SizeIs(10));
  produce(0, 0x30, kOn | kCyclic | 1, 0);
  EXPECT_THAT(node.wait(1000), IsEmpty());
  produce(0, 0x30, kCyclic | 1, 5);
  EXPECT_THAT(node.wait(100), IsEmpty());
}

// RN-63: the period counts TRIGGERs.
TEST_F(RemoteModelProducers, CyclicByTriggers) {
  produce(0, 0x30, kOn | kTriggers | kCyclic | 1, 3);
  produce(1, 0x31, kOn | kTriggers | 1, 1);
  EXPECT_THAT(node.wait(100), IsEmpty());
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(node.send("001#"), IsEmpty());
    EXPECT_THAT(node.send("001#"), IsEmpty());
    EXPECT_THAT(node.send("001#"), ElementsAre("5B0#00"));
  }
}

// RN-63: on change of the bytes last sent, looked at once a ms.
TEST_F(RemoteModelProducers, OnChange) {
  produce(0, 0x30, kOn | kChange | 2, 0);
  EXPECT_THAT(node.wait(10), IsEmpty());
  node.user_write(0x31, {7});
  EXPECT_THAT(node.drain(), IsEmpty());
  EXPECT_THAT(node.wait(10), ElementsAre("5B0#0007"));
  node.user_write(0x32, {7});  // beyond its length
  EXPECT_THAT(node.wait(10), IsEmpty());
  (void)node.send("1B1#08");
  node.user_write(0x31, {7});  // back before anybody looked
  EXPECT_THAT(node.wait(10), IsEmpty());
}

// RN-63: an event sends at once; the gap holds for all of an entry's frames.
TEST_F(RemoteModelProducers, EventsAndGap) {
  produce(0, 0x30, kOn | 1, 0, 10);
  produce(1, 0x31, 1, 0);
  node.model.event(0);
  EXPECT_THAT(node.drain(), ElementsAre("5B0#00"));
  node.model.event(0);
  node.model.event(0);
  node.model.event(1);
  node.user_write(0x30, {9});
  EXPECT_THAT(node.drain(), IsEmpty());
  EXPECT_THAT(node.wait(9), IsEmpty());
  EXPECT_THAT(node.wait(1), ElementsAre("5B0#09"));  // once, with the newest byte
  EXPECT_THAT(node.wait(100), IsEmpty());
  produce(0, 0x30, kOn | kCyclic | 1, 3, 8);
  const Texts said = node.wait(80);
  EXPECT_THAT(said, SizeIs(10));
  EXPECT_THROW(node.model.event(8), std::out_of_range);
}

// RN-64: due entries in the order of k, after answers; one in the queue at a time.
TEST_F(RemoteModelProducers, OrderOfStatements) {
  for (unsigned k = 0; k < 8; ++k) produce(k, 0x37 - k, kOn | 1, 0);
  node.hear("1A0#R1");
  for (const unsigned k : {5U, 1U, 7U, 1U}) node.model.event(k);
  node.hear("1A1#R1");
  EXPECT_THAT(node.drain(), ElementsAre("5A0#00", "5A1#00", "5B6#00", "5B2#00", "5B0#00"));
  node.model.event(3);
  for (int i = 0; i < 3; ++i) node.hear("1A0#R1");
  EXPECT_EQ(node.model.status().refused, 0);  // a statement leaves room for answers
}

// RN-63: data in OPERATE only; STATUS and IDENT always. What falls due in SAFE is not sent later.
TEST_F(RemoteModelProducers, DataInOperateOnly) {
  produce(0, 0x30, kOn | kCyclic | kChange | 1, 4);
  produce(1, 0x7E, kOn | kCyclic | 1, 4);
  produce(2, 0x7F, kOn | kCyclic | 2, 8);
  (void)node.send("000#02");
  node.user_write(0x30, {1});
  node.model.event(0);
  EXPECT_THAT(node.wait(8), ElementsAre("5FE#02", "5FE#02", "5FF#01FF"));
  node.hear("000#01");
  EXPECT_THAT(node.drain(), IsEmpty());
  EXPECT_THAT(node.wait(1), ElementsAre("5B0#01"));  // the change
}

// RN-06, RN-63: an entry that is no place in the window, or of no length, is off.
TEST_F(RemoteModelProducers, EntriesThatAreNone) {
  for (const auto &[a, length] :
       {std::pair(0x77U, 2U), std::pair(0x78U, 1U), std::pair(0x7DU, 1U), std::pair(0x80U, 1U),
        std::pair(0x30U, 0U), std::pair(0x30U, 9U), std::pair(0xFFU, 1U), std::pair(0x7EU, 9U)}) {
    produce(0, a, kOn | kCyclic | kChange | length, 1);
    node.model.event(0);
    EXPECT_THAT(node.wait(10), IsEmpty()) << a << ' ' << length;
  }
  produce(0, 0x70, kOn | kCyclic | 8, 1);
  EXPECT_THAT(node.wait(1), ElementsAre("5F0#0000000000000000"));
  produce(0, 0x77, kOn | kCyclic | 1, 1);
  EXPECT_THAT(node.wait(1), ElementsAre("5F7#00"));
}

// RN-72: bus-off forgets what is due.
TEST_F(RemoteModelProducers, BusOffForgetsWhatIsDue) {
  produce(0, 0x7E, kOn | 1, 0);
  node.hear("1A0#R1");
  node.model.event(0);
  node.model.went_bus_off();
  node.user_write(0xF01, {1});
  node.model.recovered();
  EXPECT_THAT(node.drain(), ElementsAre("5FE#8200000000010000"));
}

// NameBits 5: the window is shorter, STATUS is 1E.
TEST_F(RemoteModelProducers, FiveBitsOfName) {
  RemoteConfig config = RemoteConfig::profile("full");
  config.name_bits = 5;
  ModelNode five{config, 9};
  five.started();
  five.hear("000#01");
  five.user_write(
      0xF40, {0x17, kOn | 1, 0, 0, 0, 0, 0, 0, 0x1E, kOn | 1, 0, 0, 0, 0, 0, 0, 0x17, kOn | 2});
  for (const unsigned k : {0U, 1U, 2U}) five.model.event(k);
  EXPECT_THAT(five.drain(), ElementsAre("537#00", "53E#03"));
}

}  // namespace
}  // namespace vericansim
