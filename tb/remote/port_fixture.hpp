// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PortFixture: one node, of profile standard if nothing else is said, at the engine's port, frames
// as candump writes them.
#pragma once

#include <memory>
#include <string>

#include "remote/frame_port.hpp"
#include "remote/model_node.hpp"

namespace vericansim {

/// The node is in OPERATE, its BOOT frame gone.
class PortFixture : public ::testing::Test {
 protected:
  explicit PortFixture(unsigned name_bits = 3, unsigned number = 3,
                       const std::string &profile = "standard")
      : port{FramePort::create(profile, name_bits, 0xCAFE1234, number)} {
    port->start();
    (void)port->drain();
    operate(true);
  }

  void hear(const std::string &text) { port->receive(frame_of(text)); }
  /// A frame, and what the node says then.
  Texts send(const std::string &text) {
    hear(text);
    return drain();
  }
  void operate(bool on) { (void)send(on ? "000#01" : "000#02"); }
  /// A write of user logic.
  void write(unsigned address, unsigned byte) {
    port->user_write(address / 4, byte << 8 * (address % 4), 1U << address % 4);
  }
  void write(unsigned address, const std::vector<unsigned> &bytes) {
    for (const unsigned byte : bytes) write(address++, byte);
  }
  [[nodiscard]] std::vector<unsigned> bytes(unsigned address, unsigned n) const {
    std::vector<unsigned> read;
    for (unsigned i = 0; i < n; ++i) read.push_back(port->peek(address + i));
    return read;
  }
  Texts drain() { return texts_of(port->drain()); }
  /// What the node says in so many milliseconds.
  Texts wait(unsigned ms) {
    Texts all;
    for (; ms != 0; --ms) {
      port->ms();
      for (const std::string &text : drain()) all.push_back(text);
    }
    return all;
  }
  /// Whether STATUS says so.
  [[nodiscard]] bool stale() {
    port->clocks(200);
    const Texts said = send("1FE#R1");
    return said.size() == 1 && (frame_of(said[0]).data[0] & 0x20) != 0;
  }

  std::unique_ptr<FramePort> port;
};

}  // namespace vericansim
