// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ModelNode: a RemoteModel alone on an idle bus; frames are written as candump writes them.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/remote_model.hpp"
#include "remote/frame_texts.hpp"
#include "trace/candump.hpp"

namespace vericansim {

/// A node that has what the host sends at once, and whose frames leave at once.
class ModelNode {
 public:
  explicit ModelNode(const RemoteConfig &config, unsigned number = 3) : model{config, number} {}

  /// Joins the bus; its BOOT frame is lost.
  ModelNode &started() {
    model.start();
    (void)drain();
    return *this;
  }

  /// A frame from the bus, and what the node says then.
  Texts send(const std::string &text) {
    hear(text);
    return drain();
  }
  /// A frame from the bus; what the node has to say waits.
  void hear(const std::string &text) {
    model.receive(frame_of(text));
    model.intermission();
  }
  /// Everything that the node wants to say.
  Texts drain() {
    Texts said;
    for (; model.wants() && said.size() < 2000; model.sent()) {
      model.attempt();
      said.push_back(candump_frame(*model.wants()));
    }
    return said;
  }
  /// `ms` ticks, and what the node says in that time.
  Texts wait(unsigned ms) {
    Texts said;
    for (; ms != 0; --ms) {
      model.tick();
      for (std::string &text : drain()) said.push_back(std::move(text));
    }
    return said;
  }

  /// Bytes of the memory.
  [[nodiscard]] std::vector<std::uint8_t> bytes(unsigned address, std::size_t n) const {
    std::vector<std::uint8_t> bytes(n);
    for (std::size_t i = 0; i < n; ++i)
      bytes[i] = model.memory()[address + static_cast<unsigned>(i)];
    return bytes;
  }
  /// User logic writes bytes, one access each.
  void user_write(unsigned address, const std::vector<unsigned> &bytes) {
    for (const unsigned byte : bytes) {
      model.user_write(address / 4, byte << 8 * (address % 4), 1U << address % 4);
      ++address;
    }
  }
  /// UNLOCK with the right key.
  void unlock() {
    const std::uint32_t key = model.config().serial;
    Frame frame;
    frame.id = 0x180U | 0x7C;
    frame.dlc = 5;
    frame.data[0] = 1;
    for (unsigned i = 0; i < 4; ++i) frame.data[1 + i] = static_cast<std::uint8_t>(key >> (8 * i));
    model.receive(frame);
    model.intermission();
  }
  /// Code and A of the last request that was counted.
  [[nodiscard]] std::pair<unsigned, unsigned> last() const {
    return {static_cast<unsigned>(model.status().code), model.status().a};
  }

  RemoteModel model;
};

}  // namespace vericansim
