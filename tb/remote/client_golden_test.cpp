// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The golden vectors through the C client, on the model: RN-90, RN-93.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "remote/golden_vectors.hpp"
#include "remote/model_bus.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAreArray;

using Bytes = std::vector<std::uint8_t>;

/// Works through calls of vectors.yaml.
class GoldenCaller {
 public:
  GoldenCaller(verican_remote_t &client, std::string profile)
      : client_{client}, profile_{std::move(profile)} {}

  void carry_out(const golden::Call &call) {
    SCOPED_TRACE(call.what);
    const auto node = static_cast<std::uint8_t>(call.node);
    const auto address = static_cast<std::uint16_t>(call.address);
    if (call.what == "write") {
      ok(verican_remote_write(&client_, node, address, call.data.data(), call.data.size()));
    } else if (call.what == "read") {
      Bytes bytes(call.length);
      ok(verican_remote_read(&client_, node, address, bytes.data(), bytes.size()));
      EXPECT_EQ(bytes, call.gives_with(profile_));
    } else if (call.what == "block_read") {
      Bytes bytes(call.length);
      client_.tag = static_cast<std::uint8_t>(call.tag - 1);
      ok(verican_remote_block_read(&client_, node, address, bytes.data(), bytes.size()));
      EXPECT_EQ(bytes, call.gives_with(profile_));
    } else if (call.what == "block_write") {
      client_.tag = static_cast<std::uint8_t>(call.tag - 1);
      ok(verican_remote_block_write(&client_, node, address, call.data.data(), call.data.size()));
    } else {
      others(call);
    }
  }

 private:
  static void ok(verican_remote_result_t result) { EXPECT_EQ(result, VERICAN_REMOTE_OK); }

  void others(const golden::Call &call) {
    const auto node = static_cast<std::uint8_t>(call.node);
    if (call.what == "trigger") {
      ok(verican_remote_trigger(&client_, static_cast<std::uint8_t>(call.count)));
    } else if (call.what == "state") {
      ok(verican_remote_state(
          &client_, node,
          call.command == "operate" ? VERICAN_REMOTE_OPERATE : VERICAN_REMOTE_SAFE));
    } else if (call.what == "status") {
      status(node, call.gives_with(profile_));
    } else if (call.what == "identity") {
      identity(node, call.gives_with(profile_));
    } else if (call.what == "poll") {
      poll(call);
    } else if (call.what == "select") {
      bool here = !call.here;
      ok(verican_remote_select(&client_, call.value, call.mask, false, &here));
      EXPECT_EQ(here, call.here);
    } else {
      FAIL() << "no such call";
    }
  }

  void status(std::uint8_t node, const Bytes &row) {
    verican_remote_status_t s;
    ok(verican_remote_status(&client_, node, &s));
    const int flags = s.unlocked << 2 | s.error_passive << 3 | s.duplicate << 4 | s.stale << 5 |
                      s.watchdog << 6 | s.bus_off << 7;
    const std::array<int, 8> told{s.state | flags, s.tec,     s.rec,    s.code, s.a,
                                  s.accepted,      s.refused, s.trigger};
    EXPECT_THAT(told, ElementsAreArray(row));
  }

  void identity(std::uint8_t node, const Bytes &row) {
    verican_remote_identity_t i;
    ok(verican_remote_identity(&client_, node, &i));
    EXPECT_EQ(i.number, node);
    EXPECT_EQ(i.version, row[0]);
    EXPECT_EQ(i.features, row[1]);
    EXPECT_EQ(i.name_bits, row[2] >> 4);
    EXPECT_EQ(i.memory, 1 << (row[2] & 15));
    EXPECT_EQ(i.stage, row[3]);
    EXPECT_EQ(i.serial, row[4] | row[5] << 8 | row[6] << 16 | std::uint32_t{row[7]} << 24);
  }

  void poll(const golden::Call &call) {
    std::uint32_t expected = 0;
    for (const auto &[number, bytes] : call.nodes) expected |= 1U << number;
    verican_remote_answers_t poll;
    ok(verican_remote_poll(&client_, static_cast<std::uint16_t>(call.address),
                           static_cast<std::uint8_t>(call.length), expected, &poll));
    EXPECT_EQ(poll.answered, expected);
    for (const auto &[number, bytes] : call.nodes)
      EXPECT_EQ(Bytes(poll.data[number], poll.data[number] + call.length), bytes);
  }

  verican_remote_t &client_;
  std::string profile_;
};

std::vector<std::string> frames_of(const golden::Vector &vector) {
  std::vector<std::string> frames;
  for (const golden::Step &step : vector.steps) frames.push_back(candump_frame(step.send));
  return frames;
}

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
