// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteModelTest: node 3 in SAFE with nothing to say.
#pragma once

#include "remote/model_node.hpp"

namespace vericansim {

/// Profile full, serial number CAFE1234.
class RemoteModelTest : public ::testing::Test {
 protected:
  RemoteModelTest() { node.started(); }

  [[nodiscard]] static RemoteConfig full(std::uint32_t serial = 0xCAFE1234) {
    RemoteConfig config = RemoteConfig::profile("full");
    config.serial = serial;
    return config;
  }

  static constexpr unsigned kListen = 1;
  static constexpr unsigned kSafe = 2;
  static constexpr unsigned kOperate = 3;
  [[nodiscard]] unsigned state() const { return static_cast<unsigned>(node.model.state()); }

  ModelNode node{full()};
};

}  // namespace vericansim
