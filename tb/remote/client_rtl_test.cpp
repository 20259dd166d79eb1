// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The golden vectors through the C client, its driver and the registers of a core, on the RTL of
// the node: RN-90, RN-93.
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
  explicit ClientOnCore(const golden::Life &life) {
    RemoteConfig config = RemoteConfig::profile("small");
    config.name_bits = life.name_bits;
    config.serial = life.serial;
    node = rtl_unit(life.number, config);
    core.bus.add(*node);
    core.bus.add(ear);
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

// RN-90, RN-93.
TEST(ClientOnRtl, EveryGoldenVectorThroughRegisters) {
  for (const golden::Life &life : golden::load()) {
    ClientOnCore bus{life};
    (void)bus.take_requests();
    GoldenCaller caller{bus.client, "small"};
    for (const golden::Vector &vector : life.for_features(golden::features_of("small"))) {
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

}  // namespace
}  // namespace vericansim
