// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The C client's back end over the driver, on registers without a bus behind them (RN-90, RN-91).
#include <gtest/gtest.h>

#include <vector>

#include "driver/fake_core.hpp"
#include "verican_remote_driver.h"

namespace vericansim {
namespace {

/// Each look at the clock takes 50 us.
class ClientDriver : public ::testing::Test {
 protected:
  ClientDriver() {
    verican_config_t config = core_.config();
    config.rx_ring = ring_.data();
    config.rx_ring_size = static_cast<std::uint16_t>(ring_.size());
    EXPECT_EQ(verican_init(&device_, &config), VERICAN_OK);
    EXPECT_EQ(verican_start(&device_), VERICAN_OK);
    driver_ = {&device_, now_us, nullptr, this, 0};
    port = verican_remote_driver_port(&driver_);
  }

  void arrive(std::uint32_t flags, std::uint32_t id) {
    core_.word(VERICAN_MB_CS_OFFSET(3)) = 2U << 24 | flags << 16;
    core_.word(VERICAN_MB_ID_OFFSET(3)) = id;
    core_.word(VERICAN_IFLAG1_OFFSET) |= 1U << 3;
    EXPECT_EQ(verican_irq_handler(&device_), VERICAN_OK);
  }
  void arrive_extended(unsigned n) {
    for (; n != 0; --n) arrive(kExtended, 0x1234567);
  }
  verican_remote_result_t receive(std::uint32_t timeout_us) {
    return port.receive(port.context, &frame, timeout_us);
  }
  [[nodiscard]] unsigned waiting() const {
    std::uint16_t count = 0;
    EXPECT_EQ(verican_rx_waiting(&device_, &count), VERICAN_OK);
    return count;
  }

  void stop() { EXPECT_EQ(verican_stop(&device_), VERICAN_OK); }
  void listen_only() {
    stop();
    EXPECT_EQ(verican_set_mode(&device_, VERICAN_MODE_LISTEN_ONLY), VERICAN_OK);
    EXPECT_EQ(verican_start(&device_), VERICAN_OK);
  }

  verican_remote_port_t port{};
  verican_remote_frame_t frame{};
  std::uint32_t time_us = 0xFFFFF000;  // wraps soon

 private:
  static constexpr std::uint32_t kExtended = 1U << 5;  // IDE, in units of 65,536

  static std::uint32_t now_us(void *context) {
    return static_cast<ClientDriver *>(context)->time_us += 50;
  }

  FakeCore core_;
  std::vector<verican_frame_t> ring_ = std::vector<verican_frame_t>(5000);
  verican_t device_{};
  verican_remote_driver_t driver_{};
};

// Extended frames are passed over, also where nothing is waited for.
TEST_F(ClientDriver, ABaseFrameBehindOthersIsFound) {
  for (const std::uint32_t timeout_us : {0U, 1'000U}) {
    arrive_extended(10);
    arrive(0, 0x5A0 << 18);
    EXPECT_EQ(receive(timeout_us), VERICAN_REMOTE_OK) << timeout_us;
    EXPECT_EQ(frame.id, 0x5A0);
    EXPECT_EQ(receive(timeout_us), VERICAN_REMOTE_TIMEOUT) << timeout_us;
  }
}

// RN-91: a bus that is full of them holds nobody up: more come than are passed over.
TEST_F(ClientDriver, ABusFullOfExtendedFrames) {
  arrive_extended(4000);
  for (const std::uint32_t timeout_us : {0U, 50'000U}) {
    const std::uint32_t start = time_us;
    EXPECT_EQ(receive(timeout_us), VERICAN_REMOTE_TIMEOUT);
    EXPECT_LT(time_us - start, 60'000U) << timeout_us;
    EXPECT_NE(waiting(), 0U) << timeout_us;
  }
}

// RN-91: a device that somebody has stopped is off the bus; ARGUMENT would say that it is the
// caller's mistake. What has come before is there.
TEST_F(ClientDriver, AStoppedDeviceIsOffTheBus) {
  arrive(0, 0x5A0 << 18);
  stop();
  EXPECT_EQ(port.send(port.context, &frame), VERICAN_REMOTE_BUS_OFF);
  EXPECT_EQ(receive(1'000), VERICAN_REMOTE_OK);
  EXPECT_EQ(receive(1'000), VERICAN_REMOTE_BUS_OFF);
}

TEST_F(ClientDriver, ADeviceThatListensOnlySendsNothing) {
  listen_only();
  EXPECT_EQ(port.send(port.context, &frame), VERICAN_REMOTE_BUS_OFF);
  EXPECT_EQ(receive(1'000), VERICAN_REMOTE_TIMEOUT);
}

}  // namespace
}  // namespace vericansim
