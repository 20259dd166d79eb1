// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What user logic sees and does, on the model: RN-45, RN-46, RN-50 to RN-53.
#include <memory>

#include "remote/model_node.hpp"

namespace vericansim {

/// GoogleTest shows it so.
void PrintTo(const RemotePulse &pulse, std::ostream *out) {
  if (pulse.apply)
    *out << "apply";
  else
    *out << "written " << pulse.address << " [" << pulse.length << "]";
}

namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

RemotePulse written(unsigned address, unsigned length) { return {false, address, length}; }
const RemotePulse kApply{true, 0, 0};

std::unique_ptr<ModelNode> node_with(unsigned stage_bytes) {
  RemoteConfig config = RemoteConfig::profile("full");
  config.stage_bytes = stage_bytes;
  auto node = std::make_unique<ModelNode>(config);
  node->started();
  return node;
}

/// Node 3 in OPERATE, stage of 8 bytes.
class RemoteModelUser : public ::testing::Test {
 protected:
  RemoteModelUser() {
    node.started();
    node.hear("000#01");
    (void)node.model.take_pulses();
  }

  ModelNode node{RemoteConfig::profile("full")};
};

// RN-45: shown at the SP of INT2, with the range, whichever command wrote; not before.
TEST_F(RemoteModelUser, WritesAreShownAtInt2) {
  node.model.receive(frame_of("1A0#0102"));
  EXPECT_THAT(node.bytes(0x20, 2), ElementsAre(1, 2));
  EXPECT_THAT(node.model.take_pulses(), IsEmpty());
  node.model.intermission();
  EXPECT_THAT(node.model.take_pulses(), ElementsAre(written(0x20, 2)));
  (void)node.send("0F9#0002010203");
  EXPECT_THAT(node.model.take_pulses(), ElementsAre(written(0x200, 3)));
  (void)node.send("1FA#027700030A00");
  EXPECT_THAT(node.model.take_pulses(), IsEmpty());
  (void)node.send("1FB#0001020304050607");
  EXPECT_THAT(node.model.take_pulses(), ElementsAre(written(0x300, 7)));
  for (const char *none :
       {"1A0#", "1A0#R1", "1FE#R1", "220#01", "002#0000000000000000", "1FC#02"}) {
    (void)node.send(none);
    EXPECT_THAT(node.model.take_pulses(), IsEmpty()) << none;
  }
}

// RN-46: staged bytes stay hidden until a TRIGGER in OPERATE; reads see the live ones.
TEST_F(RemoteModelUser, StagedBytesAppearWithTheTrigger) {
  (void)node.send("18E#0102030405060708");  // 0E..15: two bytes before the stage
  EXPECT_THAT(node.bytes(0x0E, 8), ElementsAre(1, 2, 0, 0, 0, 0, 0, 0));
  EXPECT_THAT(node.model.take_pulses(), ElementsAre(written(0x0E, 8)));
  (void)node.send("1F9#1600A1A2A3A4");  // 16..19: two behind it
  EXPECT_THAT(node.bytes(0x14, 6), ElementsAre(0, 0, 0, 0, 0xA3, 0xA4));
  EXPECT_THAT(node.send("190#R4"), ElementsAre("590#00000000"));
  (void)node.model.take_pulses();
  node.model.receive(frame_of("001#"));
  EXPECT_THAT(node.model.take_pulses(), IsEmpty());
  node.model.intermission();
  EXPECT_THAT(node.model.take_pulses(), ElementsAre(kApply));
  EXPECT_THAT(node.bytes(0x0E, 12), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 0xA1, 0xA2, 0xA3, 0xA4));
}

// RN-46, RN-41: the stage takes the bytes of a block write, too.
TEST_F(RemoteModelUser, ABlockWriteIsStaged) {
  (void)node.send("1FA#02770C000A00");
  (void)node.send("1FB#0001020304050607");
  (void)node.send("1FB#01080910");
  EXPECT_THAT(node.bytes(0x0C, 8), ElementsAre(1, 2, 3, 4, 0, 0, 0, 0));
  (void)node.send("001#01");
  EXPECT_THAT(node.bytes(0x0C, 10), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 0x10));
}

// RN-46: in SAFE a TRIGGER is counted and nothing else.
TEST_F(RemoteModelUser, TriggerInSafeIsOnlyCounted) {
  (void)node.send("000#02");
  (void)node.send("190#55");
  (void)node.model.take_pulses();
  (void)node.send("001#09");
  EXPECT_THAT(node.model.take_pulses(), IsEmpty());
  EXPECT_EQ(node.bytes(0x10, 1)[0], 0);
  EXPECT_EQ(node.model.status().trigger, 9);
  (void)node.send("001#");
  EXPECT_EQ(node.model.status().trigger, 10);
  (void)node.send("000#01");
  (void)node.send("001#FF");
  EXPECT_EQ(node.bytes(0x10, 1)[0], 0x55);
  (void)node.send("001#");
  EXPECT_EQ(node.model.status().trigger, 0);  // modulo 256
}

// RN-46: stages of 0 and 16 bytes.
TEST_F(RemoteModelUser, StageSizes) {
  const auto none = node_with(0);
  none->hear("000#01");
  (void)none->send("190#55");
  EXPECT_EQ(none->bytes(0x10, 1)[0], 0x55);
  (void)none->model.take_pulses();
  (void)none->send("001#");
  EXPECT_THAT(none->model.take_pulses(), ElementsAre(kApply));
  const auto sixteen = node_with(16);
  sixteen->hear("000#01");
  (void)sixteen->send("198#0102030405060708");
  (void)sixteen->send("1A0#09");
  EXPECT_THAT(sixteen->bytes(0x18, 9), ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, 9));
  (void)sixteen->send("001#");
  EXPECT_THAT(sixteen->bytes(0x18, 9), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
}

// RN-27, RN-48: a TRIGGER that comes twice acts once more and changes nothing.
TEST_F(RemoteModelUser, ATriggerTwice) {
  (void)node.send("190#55");
  (void)node.send("001#01");
  (void)node.model.take_pulses();
  (void)node.send("001#01");
  EXPECT_THAT(node.model.take_pulses(), ElementsAre(kApply));
  EXPECT_EQ(node.bytes(0x10, 1)[0], 0x55);
  EXPECT_EQ(node.model.status().trigger, 1);
}

// RN-52: while user logic holds nothing becomes visible and no snapshot is taken.
TEST_F(RemoteModelUser, HoldDelaysWritesAndSnapshots) {
  (void)node.send("1A0#01");
  node.model.hold(true);
  node.hear("1A0#02");
  EXPECT_EQ(node.bytes(0x20, 1)[0], 1);
  node.model.hold(false);
  EXPECT_EQ(node.bytes(0x20, 1)[0], 2);
  EXPECT_THAT(node.model.take_pulses(), ElementsAre(written(0x20, 1), written(0x20, 1)));
  (void)node.send("1FA#027700030200");
  node.model.hold(true);
  node.hear("1FB#000A0B");
  EXPECT_THAT(node.model.take_pulses(), IsEmpty());
  node.model.hold(false);
  EXPECT_THAT(node.model.take_pulses(), ElementsAre(written(0x300, 2)));
  EXPECT_THAT(node.drain(), ElementsAre("5FA#027700000200"));
  node.model.hold(true);
  node.hear("1A0#R1");
  EXPECT_FALSE(node.model.wants());
  node.user_write(0x20, {3});
  node.model.hold(false);
  EXPECT_THAT(node.drain(), ElementsAre("5A0#03"));
  EXPECT_EQ(node.bytes(0xFEF, 1)[0], 0);
}

// RN-45, RN-52: a hold that ends before INT2 delays nothing that shows.
TEST_F(RemoteModelUser, AShortHoldIsNotSeen) {
  node.model.hold(true);
  node.model.receive(frame_of("1A0#02"));
  node.model.hold(false);
  EXPECT_THAT(node.model.take_pulses(), IsEmpty());
  node.model.intermission();
  EXPECT_THAT(node.model.take_pulses(), ElementsAre(written(0x20, 1)));
}

// RN-52: after 64 clocks the hold is ignored and counted, for this frame.
TEST_F(RemoteModelUser, HoldEndsByItself) {
  node.model.hold(true);
  node.hear("1A0#02");
  node.model.hold_expired();
  EXPECT_EQ(node.bytes(0x20, 1)[0], 2);
  EXPECT_EQ(node.bytes(0xFEF, 1)[0], 1);
  node.hear("1A0#03");
  EXPECT_EQ(node.bytes(0x20, 1)[0], 2);
  node.hear("1A0#04");  // the next frame at the latest
  EXPECT_EQ(node.bytes(0x20, 1)[0], 3);
  EXPECT_EQ(node.bytes(0xFEF, 1)[0], 2);
  node.model.hold_expired();
  node.hear("220#05");  // of another node: there is nothing to hold
  node.model.hold_expired();
  EXPECT_EQ(node.bytes(0xFEF, 1)[0], 3);
  node.model.hold(false);
  const RemotePulse once = written(0x20, 1);
  EXPECT_THAT(node.model.take_pulses(), ElementsAre(once, once, once));
}

// RN-51, RN-53: user logic reads everything and writes all but E00..EFF and FE0..FFF.
TEST_F(RemoteModelUser, UserPort) {
  for (unsigned word = 0; word < 0x400; ++word) {
    node.model.user_write(word, 0x04030201, 0xF);
    const unsigned address = 4 * word;
    const bool closed = (address >= 0xE00 && address < 0xF00) || address >= 0xFE0;
    EXPECT_EQ(node.model.user_read(word) == 0x04030201, !closed) << std::hex << address;
  }
  EXPECT_EQ(node.model.user_read(0xFF8 / 4), 0x083CFF01U);
  node.model.user_write(0, 0xAABBCCDD, 0x5);
  EXPECT_EQ(node.model.user_read(0), 0x04BB02DDU);
  node.user_write(0xF14, {0});  // row 0 may be read
  EXPECT_THAT(node.send("180#R4"), ElementsAre("580#DD02BB04"));
}

// RN-53: a byte that both write has the later value.
TEST_F(RemoteModelUser, TheLaterWriteCounts) {
  (void)node.send("1A0#01");
  node.user_write(0x20, {2});
  EXPECT_THAT(node.send("1A0#R1"), ElementsAre("5A0#02"));
  (void)node.send("1A0#03");
  EXPECT_EQ(node.model.user_read(8), 3U);
}

}  // namespace
}  // namespace vericansim
