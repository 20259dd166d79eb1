// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The golden vectors through the C client, on the model: RN-90, RN-93.
#include <gtest/gtest.h>

#include "remote/golden_caller.hpp"
#include "remote/model_bus.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

class GoldenClient : public ::testing::TestWithParam<const char *> {};

// RN-22, RN-90, RN-91: the client's calls are these frames and give these results.
TEST_P(GoldenClient, EveryCallIsItsVector) {
  for (const golden::Life &life : golden::load()) {
    RemoteConfig config = RemoteConfig::profile(GetParam());
    config.name_bits = life.name_bits;
    config.serial = life.serial;
    ModelBus bus;
    const RemoteModel &node = bus.add(config, life.number);
    bus.wait(0);
    verican_remote_t client;
    const verican_remote_port_t port = bus.port();
    ASSERT_EQ(verican_remote_init(&client, &port, static_cast<std::uint8_t>(life.name_bits)),
              VERICAN_REMOTE_OK);
    GoldenCaller caller{client, GetParam()};
    for (const golden::Vector &vector : life.for_features(golden::features_of(GetParam()))) {
      SCOPED_TRACE(::testing::PrintToString(vector));
      if (vector.calls.empty())
        for (const golden::Step &step : vector.steps) bus.send(step.send);
      for (const golden::Call &call : vector.calls)
        call.what == "frame" ? bus.send(call.frame) : caller.carry_out(call);
      EXPECT_EQ(bus.take_sent(), frames_of(vector));
      for (const auto &[address, bytes] : vector.memory)
        for (std::size_t i = 0; i < bytes.size(); ++i)
          EXPECT_EQ(node.memory()[address + static_cast<unsigned>(i)], bytes[i]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, GoldenClient, ::testing::Values("small", "standard", "full"),
                         [](const auto &test) { return std::string{test.param}; });

}  // namespace
}  // namespace vericansim
