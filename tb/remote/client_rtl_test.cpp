// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The C client, its driver and the registers of a core, on the RTL of the node: the golden vectors
// and the order of its frames: RN-49, RN-90, RN-93, RN-94.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "driver/driver_node.hpp"
#include "remote/golden_caller.hpp"
#include "remote/rtl_bus.hpp"
#include "verican_remote_driver.h"

namespace vericansim {
namespace {

/// A host's core with its driver, a node without a processor, and one that listens to both.
class ClientOnCore {
 public:
  ClientOnCore(const golden::Life &life, const std::string &profile,
               verican_tx_order_t order = VERICAN_TX_BY_ID) {
    RemoteConfig config = RemoteConfig::profile(profile);
    config.name_bits = life.name_bits;
    config.serial = life.serial;
    node = rtl_unit(life.number, config);
    core.bus.add(*node);
    core.bus.add(ear);
    core[0].config.tx_order = order;
    EXPECT_EQ(core[0].up(), VERICAN_OK);
    ear.start();
    driver_ = {&core[0].dev, &now_us, &idle, &core, 0};
    const verican_remote_port_t port = verican_remote_driver_port(&driver_);
    EXPECT_EQ(verican_remote_init(&client, &port, static_cast<std::uint8_t>(life.name_bits)),
              VERICAN_REMOTE_OK);
    core.run(20 * kMicrosecond);
    node->start();
    core.run(kMillisecond);
  }

  /// A frame as it is, of the host or of another node, and time for the answer.
  void send(const Frame &frame, bool from_other) {
    if (from_other) {
      ear.request(frame);
    } else {
      const unsigned flags = (frame.extended ? unsigned{VERICAN_FRAME_EXTENDED} : 0U) |
                             (frame.remote ? unsigned{VERICAN_FRAME_REMOTE} : 0U);
      verican_frame_t out = driver_frame(frame.id, frame.dlc, flags);
      std::copy(frame.data.begin(), frame.data.end(), out.data);
      EXPECT_EQ(verican_send(&core[0].dev, &out, nullptr), VERICAN_OK);
    }
    core.run(kMillisecond);
  }

  /// The frames of the host since the last call; no answers, which have bit 10 (RN-03).
  std::vector<std::string> take_requests() {
    core.run(kMillisecond);
    std::vector<std::string> requests;
    for (const Frame &frame : ear.received())
      if (frame.extended || (frame.id >> 10 & 1) == 0) requests.push_back(candump_frame(frame));
    ear.received().clear();
    return requests;
  }

  std::unique_ptr<RemoteNode> node;
  CoreNode ear{"ear", {.timing = UnitBus::timing()}, UnitBus::clock()};
  DriverBus core{1, 64, UnitBus::clock()};
  verican_remote_t client{};

 private:
  static std::uint32_t now_us(void *context) {
    return static_cast<std::uint32_t>(static_cast<DriverBus *>(context)->bus.now() / kMicrosecond);
  }
  static void idle(void *context) { static_cast<DriverBus *>(context)->run(10 * kMicrosecond); }

  verican_remote_driver_t driver_{};
};

std::vector<std::string> requests_of(const golden::Vector &vector) {
  std::vector<std::string> requests;
  for (const golden::Step &step : vector.steps)
    if (!step.from_node) requests.push_back(candump_frame(step.send));
  return requests;
}

/// The step whose frame a call sends as it is.
bool from_other(const golden::Vector &vector, const Frame &frame) {
  for (const golden::Step &step : vector.steps)
    if (step.send == frame) return step.from_node;
  return false;
}

class ClientOnRtl : public ::testing::TestWithParam<const char *> {};

// RN-90, RN-93.
TEST_P(ClientOnRtl, EveryGoldenVectorThroughRegisters) {
  const std::string profile = GetParam();
  for (const golden::Life &life : golden::load()) {
    ClientOnCore bus{life, profile};
    (void)bus.take_requests();
    GoldenCaller caller{bus.client, profile};
    for (const golden::Vector &vector : life.for_features(golden::features_of(profile))) {
      SCOPED_TRACE(::testing::PrintToString(vector));
      if (vector.calls.empty())
        for (const golden::Step &step : vector.steps) bus.send(step.send, step.from_node);
      for (const golden::Call &call : vector.calls)
        call.what == "frame" ? bus.send(call.frame, from_other(vector, call.frame))
                             : caller.carry_out(call);
      EXPECT_EQ(bus.take_requests(), requests_of(vector));
      for (const auto &[address, bytes] : vector.memory)
        for (unsigned i = 0; i < bytes.size(); ++i)
          EXPECT_EQ(bus.node->peek(address + i), bytes[i]) << std::hex << address + i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, ClientOnRtl, ::testing::Values("small", "full"),
                         [](const auto &test) { return std::string{test.param}; });

class ClientOrder : public ::testing::TestWithParam<verican_tx_order_t> {};

// RN-94, RN-49: a TRIGGER would win against the write before it on a bus on which both wait.
TEST_P(ClientOrder, TriggerDoesNotOvertakeTheWriteBeforeIt) {
  ClientOnCore bus{golden::load().front(), "small", GetParam()};
  (void)bus.take_requests();
  bus.ear.request({.id = 0x7F, .dlc = 8});
  bus.core.run(20 * kMicrosecond);
  const std::uint8_t bytes[] = {0x5A, 0xA5};
  EXPECT_EQ(verican_remote_write(&bus.client, 1, 0x10, bytes, 2), VERICAN_REMOTE_OK);
  ASSERT_TRUE(bus.ear.pending()) << "the bus is busy";
  EXPECT_EQ(verican_remote_trigger(&bus.client, 1), VERICAN_REMOTE_OK);
  EXPECT_THAT(bus.take_requests(), ::testing::ElementsAre("090#5AA5", "001#01"));
}

std::string order_name(const ::testing::TestParamInfo<verican_tx_order_t> &test) {
  constexpr const char *kNames[] = {"ById", "InOrder", "ByPriority"};
  return kNames[test.param];
}

INSTANTIATE_TEST_SUITE_P(Orders, ClientOrder,
                         ::testing::Values(VERICAN_TX_BY_ID, VERICAN_TX_IN_ORDER,
                                           VERICAN_TX_BY_PRIORITY),
                         order_name);

}  // namespace
}  // namespace vericansim
