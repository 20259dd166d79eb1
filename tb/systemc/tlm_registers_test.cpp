// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The socket of one module, in both modes: data, clocks taken, statuses, DMI, resets, debug.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "systemc/socket_bench.hpp"

namespace vericansim {
namespace {

class Socket : public ::testing::TestWithParam<TlmTiming> {};

TEST_P(Socket, ReadsAndWritesWordsHalvesAndBytes) {
  simulate([] {
    Bench bench(GetParam());
    bench.run([](Master &cpu) {
      settle(cpu);
      EXPECT_EQ(cpu.read32(reg::kMcr), kMcrReset);
      std::array<unsigned char, 4> bytes{};
      for (unsigned i = 0; i < 4; ++i)
        EXPECT_EQ(cpu.transport(kRead, i, &bytes[i], 1).status, tlm::TLM_OK_RESPONSE);
      EXPECT_EQ(bytes, (std::array<unsigned char, 4>{0x0F, 0x00, 0x90, 0xD8}));
      std::uint16_t half = 0;
      cpu.transport(kRead, 2, &half, 2);
      EXPECT_EQ(half, 0xD890);
      cpu.write32(reg::mb(5, 2), 0x11223344);
      const unsigned char byte = 0xEE;
      cpu.transport(kWrite, reg::mb(5, 2) + 1, const_cast<unsigned char *>(&byte), 1);
      half = 0xABCD;
      cpu.transport(kWrite, reg::mb(5, 2) + 2, &half, 2);
      EXPECT_EQ(cpu.read32(reg::mb(5, 2)), 0xABCDEE44u);
    });
  });
}

// AHB-Lite: a transfer takes its address phase and its data phase, the next one's address phase is
// this one's data phase; an ERROR response takes two cycles. Calls just after an edge.
TEST_P(Socket, TakesTheClocksOfItsTransfers) {
  simulate([] {
    Bench bench(GetParam());
    bench.run([](Master &cpu) {
      std::array<std::uint32_t, 16> words{};
      cpu.pause(kClock * 300 + sc_time(1000, sc_core::SC_PS));  // at an edge
      EXPECT_EQ(cpu.transport(kRead, kConfiguration, words.data(), 4).taken, kClock * 2);
      EXPECT_EQ(cpu.transport(kRead, 0x1000, words.data(), 64).taken, kClock * 17);
      EXPECT_EQ(words[2] & 0xFF, 64u);  // the third word is the number of buffers
      EXPECT_EQ(cpu.transport(kRead, 0x2000, words.data(), 4).taken, kClock * 3);
    });
  });
}

TEST_P(Socket, ErrorResponsesOfTheCoreAreAddressErrors) {
  simulate([] {
    Bench bench(GetParam());
    bench.run([&bench](Master &cpu) {
      std::uint32_t word = 0x12345678;
      for (const std::uint32_t address : {0x2000u, 0xFFFCu})
        EXPECT_EQ(cpu.transport(kRead, address, &word, 4).status, tlm::TLM_ADDRESS_ERROR_RESPONSE);
      EXPECT_EQ(word, 0x12345678u);
      EXPECT_EQ(bench.can.node().ahb().checker().errors(), 2u);
      EXPECT_EQ(cpu.transport(kRead, 0x10000, &word, 4).status, tlm::TLM_ADDRESS_ERROR_RESPONSE);
      EXPECT_EQ(bench.can.node().ahb().checker().transfers(), 2u);  // that one was none
      // A burst that runs out of the window: its first half is served.
      std::array<std::uint32_t, 4> words{1, 1, 1, 1};
      EXPECT_EQ(cpu.transport(kRead, 0x1FF8, words.data(), 16).status,
                tlm::TLM_ADDRESS_ERROR_RESPONSE);
      EXPECT_EQ(words, (std::array<std::uint32_t, 4>{0, 0, 1, 1}));
    });
  });
}

TEST_P(Socket, RefusedPayloadsDoNothing) {
  simulate([] {
    Bench bench(GetParam());
    bench.run([&bench](Master &cpu) {
      std::array<std::uint32_t, 2> words{0xFFFFFFFF, 0xFFFFFFFF};
      std::array<unsigned char, 8> enables{0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0xFF, 0};
      tlm::tlm_generic_payload payload;
      Master::fill(payload, kWrite, reg::mb(1), words.data(), 8);
      payload.set_byte_enable_ptr(enables.data());
      payload.set_byte_enable_length(8);
      const Outcome outcome = cpu.transport(payload);
      EXPECT_EQ(outcome.status, tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
      EXPECT_EQ(outcome.taken, sc_core::SC_ZERO_TIME);
      EXPECT_EQ(cpu.transport(tlm::TLM_IGNORE_COMMAND, 0, words.data(), 4).status,
                tlm::TLM_COMMAND_ERROR_RESPONSE);
      EXPECT_EQ(bench.can.node().ahb().checker().transfers(), 0u);
    });
  });
}

TEST_P(Socket, DmiIsRefusedForEveryAddress) {
  simulate([] {
    Bench bench(GetParam());
    bench.run([](Master &cpu) {
      tlm::tlm_generic_payload payload;
      std::uint32_t word = 0;
      Master::fill(payload, kRead, 0x80, &word, 4);
      payload.set_dmi_allowed(true);
      cpu.transport(payload);
      EXPECT_FALSE(payload.is_dmi_allowed());
      tlm::tlm_dmi dmi;
      EXPECT_FALSE(cpu.socket->get_direct_mem_ptr(payload, dmi));
      EXPECT_TRUE(dmi.is_none_allowed());
      EXPECT_EQ(dmi.get_start_address(), 0u);
      EXPECT_GE(dmi.get_end_address(), 0x1FFFu);
    });
  });
}

// A reset meets a transfer; during it there is no access; after it the registers are fresh.
TEST_P(Socket, AResetInTheMiddle) {
  simulate([] {
    Bench bench(GetParam());
    sc_core::sc_spawn([&bench] {
      sc_core::wait(sc_time(100, sc_core::SC_US) + kClock / 2);
      bench.rst_n.write(false);
      sc_core::wait(sc_time(50, sc_core::SC_US));
      bench.rst_n.write(true);
    });
    bench.run([](Master &cpu) {
      settle(cpu);
      cpu.write32(reg::kMcr, kMcrReset & ~reg::kMcrMdis);
      EXPECT_NE(cpu.read32(reg::kMcr), kMcrReset);
      std::uint32_t word = 0;
      Outcome outcome{tlm::TLM_OK_RESPONSE, {}};
      while (outcome.status == tlm::TLM_OK_RESPONSE)
        outcome = cpu.transport(kRead, kConfiguration, &word, 4);
      EXPECT_EQ(outcome.status, tlm::TLM_GENERIC_ERROR_RESPONSE);
      if (GetParam() == TlmTiming::kCycleExact) {  // it had begun before the reset
        EXPECT_GT(outcome.taken, sc_core::SC_ZERO_TIME);
      }
      EXPECT_GE(cpu.local(), sc_time(100, sc_core::SC_US));
      EXPECT_LE(cpu.local(), sc_time(102, sc_core::SC_US));
      outcome = cpu.transport(kRead, kConfiguration, &word, 4);
      EXPECT_EQ(outcome.status, tlm::TLM_GENERIC_ERROR_RESPONSE);
      EXPECT_EQ(outcome.taken, sc_core::SC_ZERO_TIME);
      cpu.pause(sc_time(60, sc_core::SC_US));
      settle(cpu);
      EXPECT_EQ(cpu.read32(reg::kMcr), kMcrReset);
    });
  });
}

TEST_P(Socket, DebugReadsAnyRangeAndChangesNothing) {
  simulate([] {
    Bench bench(GetParam());
    bench.run([&bench](Master &cpu) {
      settle(cpu);
      const std::uint64_t transfers = bench.can.node().ahb().checker().transfers();
      EXPECT_EQ(cpu.peek32(reg::kMcr), kMcrReset);
      EXPECT_EQ(bench.can.node().ahb().checker().transfers(), transfers);
      cpu.write32(reg::mb(2, 2), 0x55667788);
      std::array<unsigned char, 8> bytes{};
      tlm::tlm_generic_payload payload;
      Master::fill(payload, kRead, reg::mb(2, 2) + 1, bytes.data(), 3);
      EXPECT_EQ(cpu.socket->transport_dbg(payload), 3u);
      EXPECT_EQ(bytes, (std::array<unsigned char, 8>{0x77, 0x66, 0x55}));
      Master::fill(payload, kRead, 0x1FFE, bytes.data(), 8);
      EXPECT_EQ(cpu.socket->transport_dbg(payload), 2u);
      Master::fill(payload, kRead, 0x2000, bytes.data(), 4);
      EXPECT_EQ(cpu.socket->transport_dbg(payload), 0u);
      Master::fill(payload, kWrite, reg::mb(2, 2), bytes.data(), 4);
      EXPECT_EQ(cpu.socket->transport_dbg(payload), 0u);
      EXPECT_EQ(cpu.read32(reg::mb(2, 2)), 0x55667788u);
    });
  });
}

INSTANTIATE_TEST_SUITE_P(Modes, Socket,
                         ::testing::Values(TlmTiming::kCycleExact, TlmTiming::kLooselyTimed),
                         [](const auto &param) -> std::string {
                           return param.param == TlmTiming::kCycleExact ? "CycleExact"
                                                                        : "LooselyTimed";
                         });

}  // namespace
}  // namespace vericansim
