// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ModelClientTest: a C client and nodes 3, 4 and 5 on a bus of models.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "remote/model_bus.hpp"

namespace vericansim {

/// Nodes of the full profile, serial numbers CAFE1233 and on.
class ModelClientTest : public ::testing::Test {
 protected:
  using Bytes = std::vector<std::uint8_t>;

  ModelClientTest() {
    for (unsigned number = 3; number <= 5; ++number) {
      RemoteConfig config = RemoteConfig::profile("full");
      config.serial = 0xCAFE1230 + number;
      bus.add(config, number);
    }
    const verican_remote_port_t port = bus.port();
    EXPECT_EQ(verican_remote_init(&client, &port, 3), VERICAN_REMOTE_OK);
    verican_remote_frame_t boot;
    while (port.receive(port.context, &boot, 0) == VERICAN_REMOTE_OK) {
    }
  }

  verican_remote_result_t write(std::uint8_t number, std::uint16_t address, const Bytes &bytes) {
    return verican_remote_write(&client, number, address, bytes.data(), bytes.size());
  }
  verican_remote_result_t confirmed(std::uint8_t number, std::uint16_t address,
                                    const Bytes &bytes) {
    return verican_remote_write_confirmed(&client, number, address, bytes.data(), bytes.size());
  }
  Bytes read(std::uint8_t number, std::uint16_t address, std::size_t length) {
    Bytes bytes(length);
    EXPECT_EQ(verican_remote_read(&client, number, address, bytes.data(), length),
              VERICAN_REMOTE_OK);
    return bytes;
  }

  ModelBus bus;
  verican_remote_t client;
};

}  // namespace vericansim
