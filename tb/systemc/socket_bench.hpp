// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A module alone on a bus, for tests of its socket.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <systemc>
#include <utility>

#include "systemc/can_bus.hpp"
#include "systemc/register_software.hpp"
#include "systemc/systemc_rig.hpp"
#include "systemc/verican_tlm.hpp"

namespace vericansim {

using sc_core::sc_time;
inline constexpr auto kRead = tlm::TLM_READ_COMMAND;
inline constexpr auto kWrite = tlm::TLM_WRITE_COMMAND;
inline constexpr std::uint32_t kMcrReset = 0xD890000F;   // flexcan.md 1
inline constexpr std::uint32_t kConfiguration = 0x1008;  // extension page: never stalls
inline const sc_time kClock(125, sc_core::SC_NS);        // 8 MHz

/// A module alone on a bus; its reset line; and an initiator with the test's program.
struct Bench {
  explicit Bench(TlmTiming timing) : can{"can", {.timing = timing, .clock = {.phase = 1000}}} {
    bus.set_quantum(sc_time(1, sc_core::SC_US));
    bus.attach(can);
    can.rst_n.bind(rst_n);
    can.irq.bind(irq);
  }
  /// Runs a program; it must have ended after `ms`.
  void run(Master::Program program, int ms = 5) {
    Master cpu("cpu", std::move(program));
    cpu.socket.bind(can.socket);
    sc_core::sc_start(sc_time(ms, sc_core::SC_MS));
    EXPECT_TRUE(cpu.finished);
    const auto &violations = can.node().ahb().checker().violations();
    EXPECT_TRUE(violations.empty()) << violations.front();
  }

  CanBus bus{"bus"};
  VericanTlm can;
  sc_core::sc_signal<bool> rst_n{"rst_n", true}, irq{"irq"};
};

/// A program waits until the buffers are cleared after reset (docs/integration.md: 256 clocks).
inline void settle(Master &cpu) { cpu.pause(kClock * 300 + sc_time(1, sc_core::SC_PS)); }

}  // namespace vericansim
