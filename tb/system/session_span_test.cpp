// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// How long a session without an end lasts.
#include <gtest/gtest.h>

#include <memory>

#include "session/session.hpp"

namespace vericansim {
namespace {

constexpr Time kDay = 86'400 * kSecond;

// Somebody for whom time in which nothing happens may pass.
struct Passer : Operator {
  [[nodiscard]] bool passes_time() const override { return true; }
};

// docs/bridge.md: 53 days, the traffic of the scenario with it.
TEST(SessionSpan, TrafficGoesOnAsLongAsTheSession) {
  Scenario scenario;
  scenario.endless = true;
  for (const char *const name : {"a", "b"}) scenario.nodes.push_back({.name = name});
  scenario.traffic.push_back({.name = "daily", .frame = {.id = 0x123}, .period = kDay});
  scenario.listeners.push_back(
      {"passer", OwnRole{[](const OperatorContext &) { return std::make_unique<Passer>(); }}});
  SessionOptions options;
  options.limit = 52 * kDay + kDay / 2;
  Session session{{{scenario, 500e3}}, std::move(options)};
  EXPECT_EQ(session.run().front().frames, 53U);
}

}  // namespace
}  // namespace vericansim
