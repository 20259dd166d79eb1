// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The C client where a frame always waits: on a full bus with a slow host, beside a node that sends
// without end (RN-91).
#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "verican_remote.h"

namespace vericansim {
namespace {

/// A frame takes 50 us, and there is always one.
class ClientFlood : public ::testing::Test {
 protected:
  ClientFlood() {
    const verican_remote_port_t port = {send, receive, now, this};
    EXPECT_EQ(verican_remote_init(&client, &port, 3), VERICAN_REMOTE_OK);
  }

  /// The time that a call took, in time-outs for an answer; it must have this result.
  double time_of(const std::function<verican_remote_result_t()> &call,
                 verican_remote_result_t result) {
    const std::uint32_t start = now_us;
    received = 0;
    EXPECT_EQ(call(), result);
    return static_cast<double>(now_us - start) / client.timeout_us;
  }
  void expect_time_out(const std::function<verican_remote_result_t()> &call, double most) {
    EXPECT_LT(time_of(call, VERICAN_REMOTE_TIMEOUT), most);
  }

  verican_remote_t client{};
  /// What comes next.
  std::function<verican_remote_frame_t()> next = [] {
    return verican_remote_frame_t{.id = 0x5A0, .remote = false, .dlc = 1, .data = {1}};
  };
  unsigned sent = 0;

 private:
  /// A client that goes on for so long would go on for ever: then the bus is off.
  static constexpr unsigned kForEver = 1'000'000;

  static verican_remote_result_t send(void *context, const verican_remote_frame_t *) {
    ++static_cast<ClientFlood *>(context)->sent;
    return VERICAN_REMOTE_OK;
  }
  static verican_remote_result_t receive(void *context, verican_remote_frame_t *frame,
                                         std::uint32_t) {
    auto &self = *static_cast<ClientFlood *>(context);
    self.now_us += 50;
    *frame = self.next();
    return ++self.received < kForEver ? VERICAN_REMOTE_OK : VERICAN_REMOTE_BUS_OFF;
  }
  static std::uint32_t now(void *context) { return static_cast<ClientFlood *>(context)->now_us; }

  std::uint32_t now_us = 0xFFFFF000;  // wraps soon
  unsigned received = 0;
};

// RN-91: a call ends after its time-outs and those for which it looks at what has come before.
TEST_F(ClientFlood, EveryCallEnds) {
  std::uint8_t bytes[40] = {};
  verican_remote_status_t status;
  verican_remote_identity_t identity;
  verican_remote_answers_t answers;
  const double tries = 2.1 * client.tries;
  expect_time_out([&] { return verican_remote_read(&client, 4, 0x20, bytes, 4); }, tries);
  expect_time_out([&] { return verican_remote_write_confirmed(&client, 4, 0x20, bytes, 4); },
                  tries * client.tries);
  expect_time_out([&] { return verican_remote_status(&client, 4, &status); }, tries);
  expect_time_out([&] { return verican_remote_identity(&client, 4, &identity); }, tries);
  expect_time_out([&] { return verican_remote_poll(&client, 0x20, 1, 0x10, &answers); }, 2.1);
  expect_time_out([&] { return verican_remote_assign(&client, 1, 4); }, tries);
  expect_time_out([&] { return verican_remote_block_read(&client, 4, 0x20, bytes, 40); }, tries);
  expect_time_out([&] { return verican_remote_block_write(&client, 4, 0x20, bytes, 40); }, tries);
}

// RN-91: what comes of nobody's answer is what comes of it on an empty bus.
TEST_F(ClientFlood, NobodyIsThere) {
  verican_remote_answers_t answers;
  EXPECT_LT(time_of([&] { return verican_remote_poll(&client, 0x30, 1, 0, &answers); },
                    VERICAN_REMOTE_OK),
            2.1);
  EXPECT_EQ(answers.answered, 0U);
  bool here = true;
  EXPECT_LT(time_of([&] { return verican_remote_select(&client, 0, 0, false, &here); },
                    VERICAN_REMOTE_OK),
            2.1);
  EXPECT_FALSE(here);
  verican_remote_identity_t node;
  std::size_t count = 1;
  EXPECT_LT(time_of([&] { return verican_remote_scan(&client, &node, &count); }, VERICAN_REMOTE_OK),
            7.0);
  EXPECT_EQ(count, 0U);
}

// RN-91: a refusal that might have been an older one is told at the end.
TEST_F(ClientFlood, ASuspectedRefusalIsTold) {
  next = [this, others = next, told = false]() mutable {
    if (sent == 0 || std::exchange(told, true)) return others();
    return verican_remote_frame_t{.id = 0x67E,
                                  .remote = false,
                                  .dlc = 8,
                                  .data = {2, 0, 0, VERICAN_REMOTE_CODE_ADDRESS, 0x78, 0, 1, 0}};
  };
  std::uint8_t byte = 0;
  EXPECT_LT(time_of([&] { return verican_remote_read(&client, 4, 0xE00, &byte, 1); },
                    VERICAN_REMOTE_REFUSED),
            2.1);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_ADDRESS);
}

// RN-40: a node that sends DATA without end: bytes in their order as far as they were asked for.
TEST_F(ClientFlood, DataWithoutEnd) {
  std::uint8_t bytes[40] = {};
  for (const unsigned step : {0U, 1U}) {  // always the same, or counting
    next = [step, seq = 0U]() mutable {
      seq += step;
      return verican_remote_frame_t{
          .id = 0x67B, .remote = false, .dlc = 8, .data = {static_cast<std::uint8_t>(seq)}};
    };
    expect_time_out([&] { return verican_remote_block_read(&client, 4, 0x20, bytes, 40); },
                    2.1 * client.tries);
  }
}

// RN-42: a node that says without end that a block write is open.
TEST_F(ClientFlood, OpenWithoutEnd) {
  next = [this] {
    return verican_remote_frame_t{
        .id = 0x67A, .remote = false, .dlc = 6, .data = {2, client.tag, VERICAN_REMOTE_CODE_OPEN}};
  };
  std::uint8_t bytes[40] = {};
  expect_time_out([&] { return verican_remote_block_write(&client, 4, 0x20, bytes, 40); },
                  2.2 * client.tries);
}

}  // namespace
}  // namespace vericansim
