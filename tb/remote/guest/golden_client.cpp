// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// remote_golden_client: the golden vectors through the C client (RN-93), on a CAN interface of
// Linux as tb/socketcan/guest/remote.sh runs it, or through socketcand as
// tb/remote/c_client_cases.py does. Environment: VERICAN_INTERFACE or VERICAN_SOCKETCAND (the
// port), VERICAN_VECTORS (vectors.yaml), VERICAN_LIFE (which of its lives), VERICAN_PROFILE of the
// node.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "remote/golden_caller.hpp"
#include "remote/guest/socketcand_client.hpp"
#include "trace/candump.hpp"
#include "verican_remote_socketcan.h"

namespace vericansim {
namespace {

std::string setting(const char *name) {
  const char *value = std::getenv(name);
  if (value == nullptr) throw std::runtime_error(std::string{name} + " is not set");
  return value;
}

/// A way to a bus for the client, and another for frames that it does not send.
class Way {
 public:
  Way() = default;
  virtual ~Way() = default;
  Way(const Way &) = delete;
  Way &operator=(const Way &) = delete;

  virtual verican_remote_port_t port() = 0;
  virtual void put(const Frame &frame) = 0;
};

class OnInterface : public Way {
 public:
  explicit OnInterface(const std::string &interface) {
    EXPECT_EQ(verican_remote_socketcan_open(&socket_, interface.c_str()), 0);
    EXPECT_EQ(verican_remote_socketcan_open(&raw_, interface.c_str()), 0);
  }
  ~OnInterface() override {
    verican_remote_socketcan_close(&raw_);
    verican_remote_socketcan_close(&socket_);
  }
  verican_remote_port_t port() override { return verican_remote_socketcan_port(&socket_); }
  void put(const Frame &frame) override {
    can_frame out{};
    out.can_id =
        frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
    out.can_dlc = frame.dlc;
    std::memcpy(out.data, frame.data.data(), sizeof out.data);
    ASSERT_EQ(::write(raw_.fd, &out, sizeof out), static_cast<ssize_t>(sizeof out));
  }

 private:
  verican_remote_socketcan_t socket_{}, raw_{};
};

class OnSocketcand : public Way {
 public:
  explicit OnSocketcand(std::uint16_t port) : client_{port}, raw_{port} {}
  verican_remote_port_t port() override { return client_.port(); }
  void put(const Frame &frame) override { ASSERT_TRUE(raw_.send(frame)); }

 private:
  SocketcandClient client_, raw_;
};

/// The way that the environment names.
std::unique_ptr<Way> way() {
  if (std::getenv("VERICAN_SOCKETCAND") == nullptr)
    return std::make_unique<OnInterface>(setting("VERICAN_INTERFACE"));
  const unsigned long port = std::stoul(setting("VERICAN_SOCKETCAND"));
  return std::make_unique<OnSocketcand>(static_cast<std::uint16_t>(port));
}

/// The client on its way.
class OnBus {
 public:
  explicit OnBus(unsigned name_bits) {
    EXPECT_EQ(verican_remote_init(&client, &port_, static_cast<std::uint8_t>(name_bits)),
              VERICAN_REMOTE_OK);
    client.timeout_us = 5'000'000;  // the simulation shares the computer with others
  }

  /// A frame as it is; the answers, which the client would take for those to its next question, and
  /// the frame itself if it looks like one.
  void send(const Frame &frame, const std::vector<Frame> &answers) const {
    constexpr unsigned kStatement = 0x400;  // RN-03
    way_->put(frame);
    if (!frame.extended && (frame.id & kStatement) != 0) await(frame);
    for (const Frame &answer : answers) await(answer);
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

  verican_remote_t client{};

 private:
  std::unique_ptr<Way> way_ = way();
  verican_remote_port_t port_ = way_->port();
};

void expect_memory(OnBus &bus, const golden::Vector &vector, unsigned number) {
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
TEST(GoldenOnBus, EveryVector) {
  const std::string profile = setting("VERICAN_PROFILE");
  const golden::Life life =
      golden::load(setting("VERICAN_VECTORS")).at(std::stoul(setting("VERICAN_LIFE")));
  OnBus bus{life.name_bits};
  // The bus has waited for who comes by socketcand; on an interface the node has begun before.
  if (std::getenv("VERICAN_SOCKETCAND") != nullptr) bus.await(life.boot);
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
