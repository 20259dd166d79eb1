// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// remote_golden_client: the golden vectors through the C client on a CAN interface of Linux, as
// tb/socketcan/guest/remote.sh runs it (RN-93). Environment: VERICAN_INTERFACE, VERICAN_VECTORS
// (vectors.yaml), VERICAN_LIFE (which of its lives), VERICAN_PROFILE of the node.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "remote/golden_caller.hpp"
#include "trace/candump.hpp"
#include "verican_remote_socketcan.h"

namespace vericansim {
namespace {

std::string setting(const char *name) {
  const char *value = std::getenv(name);
  if (value == nullptr) throw std::runtime_error(std::string{name} + " is not set");
  return value;
}

/// The client, and a socket for frames that it does not send.
class OnInterface {
 public:
  OnInterface(const std::string &interface, unsigned name_bits) {
    EXPECT_EQ(verican_remote_socketcan_open(&socket_, interface.c_str()), 0);
    EXPECT_EQ(verican_remote_socketcan_open(&raw_, interface.c_str()), 0);
    port_ = verican_remote_socketcan_port(&socket_);
    EXPECT_EQ(verican_remote_init(&client, &port_, static_cast<std::uint8_t>(name_bits)),
              VERICAN_REMOTE_OK);
    client.timeout_us = 5'000'000;  // the simulation shares the computer with others
  }
  ~OnInterface() {
    verican_remote_socketcan_close(&raw_);
    verican_remote_socketcan_close(&socket_);
  }
  OnInterface(const OnInterface &) = delete;
  OnInterface &operator=(const OnInterface &) = delete;

  /// A frame as it is; the answers, which the client would take for those to its next question, and
  /// the frame itself if it looks like one.
  void send(const Frame &frame, const std::vector<Frame> &answers) const {
    constexpr unsigned kStatement = 0x400;  // RN-03
    put(frame);
    if (!frame.extended && (frame.id & kStatement) != 0) await(frame);
    for (const Frame &answer : answers) await(answer);
  }

  verican_remote_t client{};

 private:
  void put(const Frame &frame) const {
    can_frame out{};
    out.can_id =
        frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
    out.can_dlc = frame.dlc;
    std::memcpy(out.data, frame.data.data(), sizeof out.data);
    ASSERT_EQ(::write(raw_.fd, &out, sizeof out), static_cast<ssize_t>(sizeof out));
  }

  /// Takes frames until this one has come.
  void await(const Frame &wanted) const {
    verican_remote_frame_t in;
    while (port_.receive(port_.context, &in, client.timeout_us) == VERICAN_REMOTE_OK) {
      Frame frame{in.id, false, in.remote, in.dlc, {}};
      std::copy_n(in.data, in.remote ? 0 : in.dlc, frame.data.begin());
      if (frame == wanted) return;
    }
    ADD_FAILURE() << candump_frame(wanted) << " has not come";
  }

  verican_remote_socketcan_t socket_{}, raw_{};
  verican_remote_port_t port_{};
};

void expect_memory(OnInterface &bus, const golden::Vector &vector, unsigned number) {
  for (const auto &[address, bytes] : vector.memory) {
    std::vector<std::uint8_t> seen(bytes.size());
    EXPECT_EQ(verican_remote_read(&bus.client, static_cast<std::uint8_t>(number), address,
                                  seen.data(), seen.size()),
              VERICAN_REMOTE_OK);
    EXPECT_EQ(seen, bytes);
  }
}

std::vector<Frame> answers_to(const Frame &frame, const golden::Vector &vector,
                              const std::string &profile) {
  for (const golden::Step &step : vector.steps)
    if (step.send == frame) return step.answers_of(profile);
  return {};
}

// RN-93.
TEST(GoldenOnInterface, EveryVector) {
  const std::string profile = setting("VERICAN_PROFILE");
  const golden::Life life =
      golden::load(setting("VERICAN_VECTORS")).at(std::stoul(setting("VERICAN_LIFE")));
  OnInterface bus{setting("VERICAN_INTERFACE"), life.name_bits};
  GoldenCaller caller{bus.client, profile};
  unsigned number = life.number;
  for (const golden::Vector &vector : life.for_features(golden::features_of(profile))) {
    SCOPED_TRACE(::testing::PrintToString(vector));
    if (vector.calls.empty())
      for (const golden::Step &step : vector.steps) bus.send(step.send, step.answers_of(profile));
    for (const golden::Call &call : vector.calls)
      call.what == "frame" ? bus.send(call.frame, answers_to(call.frame, vector, profile))
                           : caller.carry_out(call);
    number = vector.node.value_or(number);
    expect_memory(bus, vector, number);
  }
}

}  // namespace
}  // namespace vericansim
