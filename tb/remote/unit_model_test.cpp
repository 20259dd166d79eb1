// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The model of a remote node on an engine: golden vectors bit by bit, and what a model of whole
// frames does not show: instants, arbitration, errors, bus-off (RN-15, RN-21, RN-45, RN-55, RN-72).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/faults.hpp"
#include "node/remote_model_node.hpp"
#include "remote/frame_texts.hpp"
#include "remote/golden_vectors.hpp"
#include "remote/unit_bus.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::unique_ptr<RemoteUnit> model_unit(const RemoteConfig &config, unsigned number) {
  return std::make_unique<RemoteModelNode>("unit", config, number, UnitBus::timing(),
                                           UnitBus::clock());
}

/// A place of the trace of a node at each of its sample points.
class Places : public BusObserver {
 public:
  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId node, const BitRecord &bit) override {
    if (node != 2) return;
    if (bit.after.rx_valid) valid = bit.time;
    if (bit.at.field == Field::kInt && bit.at.left == 1) int2 = bit.time;
    if (bit.at.field == Field::kSof) sof = bit.time;
  }
  Time valid = 0, int2 = 0, sof = 0;
};

class UnitModel : public ::testing::Test {
 protected:
  UnitModel() : bus{model_unit(RemoteConfig::profile("full"), 3)} {
    bus.bus.add(places);
    (void)bus.start();
  }
  Places places;
  UnitBus bus;
};

// Every vector bit by bit; RN-24 to RN-26, RN-40, RN-41, RN-46.
TEST(UnitModelGolden, EveryVectorAnswersAsWritten) {
  for (const golden::Life &life : golden::load()) {
    RemoteConfig config = RemoteConfig::profile("full");
    config.name_bits = life.name_bits;
    config.serial = life.serial;
    UnitBus bus{model_unit(config, life.number)};
    EXPECT_THAT(bus.start(), ElementsAre(candump_frame(life.boot)));
    for (const golden::Vector &vector : life.vectors) {
      SCOPED_TRACE(::testing::PrintToString(vector));
      for (const golden::Step &step : vector.steps) {
        std::vector<std::string> wanted;
        for (const Frame &frame : step.answers_of("full")) wanted.push_back(candump_frame(frame));
        EXPECT_EQ(bus.send(step.send, step.from_node), wanted);
      }
      for (const auto &[address, bytes] : vector.memory)
        for (std::size_t i = 0; i < bytes.size(); ++i)
          EXPECT_EQ(bus.unit->peek(address + static_cast<unsigned>(i)), bytes[i]);
    }
  }
}

// RN-45: pulses begin at the SP of INT2.
TEST_F(UnitModel, PulsesAfterInt2) {
  std::vector<std::pair<RemotePulse, Time>> pulses;
  bus.unit->on_pulse = [&](const RemotePulse &p) { pulses.emplace_back(p, bus.bus.now()); };
  (void)bus.send(frame_of("1A0#0102"));
  ASSERT_EQ(pulses.size(), 1U);
  EXPECT_EQ(pulses[0].first, (RemotePulse{false, 0x20, 2}));
  EXPECT_EQ(pulses[0].second, places.int2);
  (void)bus.send(frame_of("000#01"));
  (void)bus.send(frame_of("001#01"));
  ASSERT_EQ(pulses.size(), 2U);
  EXPECT_TRUE(pulses[1].first.apply);
  EXPECT_EQ(pulses[1].second, places.int2);
}

// RN-55: the answer follows the intermission at once: SOF five bits after EOF6 (EOF7, INT1..3).
TEST_F(UnitModel, TheAnswerFollowsAtOnce) {
  bus.host.request(frame_of("1A0#R1"));
  places.valid = 0;
  while (places.valid == 0) bus.run_bits(1);
  const Time valid = places.valid;
  places.sof = 0;
  while (places.sof == 0) bus.run_bits(1);
  EXPECT_EQ(places.sof - valid, 5 * UnitBus::kBit);
}

/// Three nodes, with these numbers.
std::vector<std::unique_ptr<RemoteUnit>> three(unsigned a, unsigned b, unsigned c) {
  std::vector<std::unique_ptr<RemoteUnit>> units;
  for (const unsigned number : {a, b, c})
    units.push_back(model_unit(RemoteConfig::profile("full"), number));
  return units;
}

// RN-21: three nodes answer a poll, sorted by arbitration.
TEST(UnitModels, APollIsSortedByArbitration) {
  UnitBus bus{three(7, 3, 5)};
  EXPECT_THAT(bus.start(),
              ElementsAre("5FE#0200000000000000", "6FE#0200000000000000", "7FE#0200000000000000"));
  EXPECT_THAT(bus.send(frame_of("0A0#R1")), ElementsAre("5A0#00", "6A0#00", "7A0#00"));
}

// RN-12: HERE of several nodes is one frame on the bus.
TEST(UnitModels, HereOfSeveralNodesIsOneFrame) {
  UnitBus bus{three(0, 1, 0)};
  EXPECT_THAT(bus.start(), IsEmpty());
  EXPECT_THAT(bus.send(frame_of("002#0000000000000000")), ElementsAre("402#"));
  for (const auto &unit : bus.units) EXPECT_EQ(decode_trace(unit->trace()).tec, 0);
}

// RN-15: nobody acknowledges: after RETRY attempts the frame is dropped, TEC has risen by 64.
TEST_F(UnitModel, AttemptsWithoutAcknowledgeEnd) {
  bus.unit->user_write(0xF40 / 4, 0x00009120, 0xF);  // producer: 20 [1] by event
  (void)bus.send(frame_of("000#01"));
  bus.host.stop();
  bus.other.stop();
  bus.run_bits(20);
  bus.unit->event(0);
  bus.run_bits(2000);
  const Trace trace = decode_trace(bus.unit->trace());
  EXPECT_EQ(trace.tec, 64);
  EXPECT_TRUE(bus.unit->idle());
  EXPECT_EQ(bus.unit->peek(0xFEB), 1);
}

// RN-72: bus-off; the recovery waits for the back-off; then STATUS tells.
TEST_F(UnitModel, BusOffAndBack) {
  bus.unit->user_write(0xF04 / 4, 0x00000A05, 0xB);  // back-off 5 ms, LIFE 100 ms, RETRY 0
  bus.unit->user_write(0xF40 / 4, 0x00009120, 0xF);
  (void)bus.send(frame_of("000#01"));
  (void)bus.send(frame_of("1A0#R1"));  // RETRY holds from the frame behind this one on
  EXPECT_EQ(bus.unit->state(), RemoteState::kOperate);
  const Time from = bus.bus.now();
  LevelFault deaf{2, Effect::kRecessive, {from, from + 3 * kMillisecond}};
  bus.bus.add(deaf);
  bus.unit->event(0);
  const auto off = [&] { return decode_trace(bus.unit->trace()).bus_off; };
  ASSERT_TRUE(bus.bus.run_until(off, 3 * kMillisecond));
  const Time begin = bus.bus.now();
  bus.run_bits(50);
  EXPECT_EQ(bus.unit->state(), RemoteState::kSafe);
  (void)bus.settle(100);
  ASSERT_TRUE(bus.bus.run_until([&] { return !off(); }, 20 * kMillisecond));
  const Time sequences = 128 * 11 * UnitBus::kBit;
  EXPECT_GE(bus.bus.now() - begin, 5 * kMillisecond);
  EXPECT_LE(bus.bus.now() - begin, 6 * kMillisecond + sequences);
  EXPECT_THAT(bus.settle(), ElementsAre("5FE#8200000000010000"));
  EXPECT_EQ(bus.unit->peek(0xFED), 1);
}

// RN-60: RESTART between two frames; the node is back after integration with what it had.
TEST_F(UnitModel, Restart) {
  (void)bus.send(frame_of("1A0#5A"));
  bus.unit->user_write(0xF00 / 4, 0x05, 0x1);
  EXPECT_THAT(bus.send(frame_of("000#8103")), ElementsAre("6FE#0200000000020000"));
  EXPECT_THAT(bus.send(frame_of("2A0#R1")), ElementsAre("6A0#5A"));
}

// RN-52: a hold delays what is shown; after 64 clocks it is ignored.
TEST_F(UnitModel, Hold) {
  std::vector<Time> shown;
  bus.unit->on_pulse = [&](const RemotePulse &) { shown.push_back(bus.bus.now()); };
  bus.unit->hold(true);
  (void)bus.send(frame_of("1A0#01"));
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_GE(shown[0] - places.valid, 64 * 125 * kNanosecond);
  EXPECT_LT(shown[0] - places.valid, 70 * 125 * kNanosecond);
  EXPECT_EQ(bus.unit->peek(0xFEF), 1);
}

// RN-70: the watchdog by the node's own clock.
TEST_F(UnitModel, Watchdog) {
  bus.unit->user_write(0xF00 / 4, 0x000A0000, 0xC);  // 10 ms
  (void)bus.send(frame_of("000#01"));
  const Time begin = bus.bus.now();
  ASSERT_TRUE(bus.bus.run_until([&] { return bus.unit->safe(); }, 20 * kMillisecond));
  EXPECT_GE(bus.bus.now() - begin, 9 * kMillisecond - kMillisecond / 5);
  EXPECT_LE(bus.bus.now() - begin, 11 * kMillisecond);
}

}  // namespace
}  // namespace vericansim
