// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Who may send what: RN-10 to RN-15, RN-21.
#include <gmock/gmock.h>

#include "bus/faults.hpp"
#include "remote/random_host.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Trace trace_of(const Node &node) { return decode_trace(node.trace()); }

/// Who has sent which identifiers, from the traces of all nodes.
class Senders : public BusObserver {
 public:
  explicit Senders(const RtlBus &bus) : bus_{bus} {}
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId node, const BitRecord &bit) override {
    if (!bit.after.tx_ok || node < 2) return;
    by_id[static_cast<RemoteNode &>(*bus_.units[node - 2]).frame().id].insert(node);
  }
  std::map<std::uint32_t, std::set<NodeId>> by_id;

 private:
  const RtlBus &bus_;
};

// RN-21: three nodes answer a poll; arbitration sorts them; the values are of one moment.
TEST(RtlSenders, APollIsSortedByArbitration) {
  RtlBus bus{std::vector<unsigned>{7, 3, 5}};
  EXPECT_THAT(bus.start(),
              ElementsAre("5FE#0200000000000000", "6FE#0200000000000000", "7FE#0200000000000000"));
  EXPECT_THAT(bus.send("0A0#5A"), IsEmpty());
  bus.host.request(frame_of("0A0#R1"));
  bus.host.request(frame_of("0A0#77"));  // before the answers
  EXPECT_THAT(bus.settle(), ElementsAre("5A0#5A", "6A0#5A", "7A0#5A"));
}

// RN-12, AR-10: HERE of several nodes is one frame on the bus, and nobody counts an error.
TEST(RtlSenders, HereOfSeveralNodesIsOneFrame) {
  RtlBus bus{std::vector<unsigned>{0, 1, 0}};
  EXPECT_THAT(bus.start(), IsEmpty());  // RN-07
  EXPECT_THAT(bus.send("002#0000000000000000"), ElementsAre("402#"));
  for (const auto &unit : bus.units) EXPECT_EQ(trace_of(*unit).tec, 0);
}

// RN-10: a read and a write of the same address by two calls that the host makes at once: answer
// and write do not collide, and nobody counts an error.
TEST(RtlSenders, AnswerAndWriteDoNotCollide) {
  RtlBus bus{std::vector<unsigned>{3}};
  (void)bus.start();
  for (unsigned i = 0; i < 20; ++i) {
    bus.host.request(frame_of("1A0#R1"));
    bus.host.request(frame_of("1A0#5A"));
    EXPECT_EQ(bus.settle().size(), 1U);
  }
  EXPECT_EQ(trace_of(bus.host).tec, 0);
  EXPECT_EQ(trace_of(bus.node()).tec, 0);
  EXPECT_EQ(bus.node().peek(0x20), 0x5A);
}

// RN-11, RN-15: two nodes with one number and different bytes destroy each other's answers; the
// frames are dropped after RETRY attempts, TEC has risen by 64 at most, nobody is bus-off.
TEST(RtlSenders, DoubledNumberEndsInSilence) {
  RtlBus bus{std::vector<unsigned>{3, 3}};
  (void)bus.start();
  bus.node(0).user_write(0x20 / 4, 0x11, 1);
  bus.node(1).user_write(0x20 / 4, 0x22, 1);
  EXPECT_THAT(bus.send("1A0#R1"), IsEmpty());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LE(trace_of(bus.node(i)).tec, 64);
    EXPECT_GE(trace_of(bus.node(i)).tec, 56);
    EXPECT_FALSE(trace_of(bus.node(i)).bus_off);
  }
  EXPECT_THAT(bus.send("1A4#7F"), IsEmpty());  // they still work
  EXPECT_EQ(bus.node(1).peek(0x24), 0x7F);
}

// RN-11: a statement under the own number sets DUP; that of another node, and one's own, do not.
TEST(RtlSenders, StatementUnderTheOwnNumberIsNoticed) {
  RtlBus bus{std::vector<unsigned>{3, 4}};
  (void)bus.start();
  (void)bus.send("1A0#R1");
  (void)bus.UnitBus::send(frame_of("620#00"), true);
  EXPECT_EQ(bus.node(0).peek(remote_map::kStatus), 0x02);
  (void)bus.UnitBus::send(frame_of("5A0#01"), true);
  EXPECT_EQ(bus.node(0).peek(remote_map::kStatus), 0x12);
  EXPECT_EQ(bus.node(0).peek(0x20), 0);
  EXPECT_EQ(bus.node(1).peek(remote_map::kStatus), 0x12);  // by 620
}

// RN-14: a remote frame with dir = 1 is no request, even under the own number.
TEST(RtlSenders, RemoteFrameOfAStatementIsIgnored) {
  RtlBus bus{std::vector<unsigned>{3}};
  (void)bus.start();
  EXPECT_THAT(bus.UnitBus::send(frame_of("5A0#R1"), true), IsEmpty());
  EXPECT_EQ(bus.node().peek(remote_map::kStatus), 0x02);
  EXPECT_EQ(bus.node().peek(remote_map::kStatus + 6), 0);
}

// RN-15: nobody acknowledges: eight attempts, then silence.
TEST(RtlSenders, AttemptsWithoutAcknowledgeEnd) {
  RtlBus bus{std::vector<unsigned>{3}};
  (void)bus.start();
  bus.places.valid = 0;
  bus.host.request(frame_of("1A0#R1"));
  while (bus.places.valid == 0) bus.run_bits(1);
  PlaceFault deaf{2, {.field = Field::kAck}, Effect::kRecessive};
  bus.bus.add(deaf);
  EXPECT_THAT(bus.settle(), IsEmpty());
  EXPECT_EQ(deaf.hits(), 8U);
  EXPECT_EQ(trace_of(bus.node()).tec, 64);
}

// RN-10, RN-13: random requests to six nodes: no identifier has two senders, none has dir 0.
TEST(RtlSenders, NoIdentifierHasTwoSenders) {
  RtlBus bus{std::vector<unsigned>{2, 3, 4, 5, 6, 7}};
  Senders senders{bus};
  bus.bus.add(senders);
  (void)bus.start();
  RandomHost host{7, {0, 1, 2, 3, 4, 5, 6, 7}};
  for (unsigned i = 0; i < 2000; ++i) {
    Frame frame = host.frame();
    frame.id &= frame.extended ? ~0U : 0x3FFU;
    if (!frame.extended && frame.id == 3) continue;  // ASSIGN doubles numbers
    (void)bus.UnitBus::send(frame);
  }
  EXPECT_GT(senders.by_id.size(), 100U);
  for (const auto &[id, nodes] : senders.by_id) {
    EXPECT_GE(id, 0x400U);
    if (id != 0x402) {
      EXPECT_EQ(nodes.size(), 1U) << std::hex << id;
      EXPECT_EQ(*nodes.begin(), (id >> 7 & 7)) << std::hex << id;
    }
  }
  bus.bus.remove(senders);
}

}  // namespace
}  // namespace vericansim
