// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the tests of the Linux loop share: the accesses that bring a controller up.
#pragma once

#include <cstdint>
#include <functional>

namespace vericansim::test {

/// Reads and writes registers of controller 0, 1, ... by offset.
struct RegisterPort {
  std::function<std::uint32_t(std::uint32_t address)> read;
  std::function<void(std::uint32_t address, std::uint32_t value)> write;
};

/// Controller `n` at 8 clocks a bit: MB1 receives anything, MB63 sends, both interrupt.
void bring_up(const RegisterPort &port, unsigned n);
/// Sends a base frame of four bytes from MB63.
void send_frame(const RegisterPort &port, unsigned n, std::uint32_t id, std::uint32_t data);

}  // namespace vericansim::test
