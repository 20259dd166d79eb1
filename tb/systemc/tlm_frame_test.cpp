// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Two modules on a CanBus: a frame by plain register accesses, in both modes; pins and lines.
#include <gtest/gtest.h>

#include <string>

#include "model/registers.hpp"
#include "systemc/can_bus.hpp"
#include "systemc/register_software.hpp"
#include "systemc/systemc_rig.hpp"
#include "systemc/verican_tlm.hpp"

namespace vericansim {
namespace {

class Exchange : public ::testing::TestWithParam<TlmTiming> {};

// The frame, and both interrupts, reach the software; the lines fall when the flags are cleared.
TEST_P(Exchange, AFrameGoesFromModuleToModule) {
  simulate([] {
    const TlmConfig config{.timing = GetParam()};
    CanBus bus("bus");
    bus.set_quantum(sc_core::sc_time(10, sc_core::SC_US));
    VericanTlm a("a", config), b("b", config);
    bus.attach(a);
    bus.attach(b);
    sc_core::sc_signal<bool> irq_a("irq_a"), irq_b("irq_b"), irq_mb_b("irq_mb_b");
    a.irq.bind(irq_a);
    b.irq.bind(irq_b);
    b.irq_mb.bind(irq_mb_b);
    Master sender("sender", [&](Master &cpu) {
      join(cpu);
      cpu.pause(sc_core::sc_time(300, sc_core::SC_US));
      send_plain(cpu, 0x123, 0xCAFE);
      cpu.sync();
      while (!irq_a.read()) cpu.wait(irq_a.posedge_event());
      EXPECT_EQ(cpu.read32(reg::kIflag1), 0x100u);
      cpu.write32(reg::kIflag1, 0x100);
      cpu.pause(sc_core::sc_time(20, sc_core::SC_US));
      EXPECT_FALSE(irq_a.read());
    });
    Master receiver("receiver", [&](Master &cpu) {
      join(cpu);
      cpu.sync();
      while (!irq_b.read()) cpu.wait(irq_b.posedge_event());
      EXPECT_TRUE(irq_mb_b.read());
      EXPECT_EQ(cpu.read32(reg::kIflag1), 0x1u);
      const std::uint32_t cs = cpu.read32(reg::mb(0));
      EXPECT_EQ(cs & (reg::kCodeMask | 0xF0000u), 0x02020000u);  // FULL, two bytes
      EXPECT_EQ(cpu.read32(reg::mb(0, 1)), 0x123u << 18);
      EXPECT_EQ(cpu.read32(reg::mb(0, 2)) & 0xFFFF0000u, 0xCAFE0000u);
      cpu.write32(reg::kIflag1, 0x1);
      cpu.read32(reg::kTimer);
    });
    sender.socket.bind(a.socket);
    receiver.socket.bind(b.socket);
    sc_core::sc_start(sc_core::sc_time(2, sc_core::SC_MS));
    EXPECT_TRUE(sender.finished);
    EXPECT_TRUE(receiver.finished);
    EXPECT_TRUE(a.node().ahb().checker().violations().empty());
    EXPECT_TRUE(b.node().ahb().checker().violations().empty());
  });
}

INSTANTIATE_TEST_SUITE_P(Modes, Exchange,
                         ::testing::Values(TlmTiming::kCycleExact, TlmTiming::kLooselyTimed),
                         [](const auto &param) -> std::string {
                           return param.param == TlmTiming::kCycleExact ? "CycleExact"
                                                                        : "LooselyTimed";
                         });

}  // namespace
}  // namespace vericansim
