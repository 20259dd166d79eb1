// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The socket of one module: data, clocks taken, statuses, resets, several initiators, debug.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "systemc/can_bus.hpp"
#include "systemc/register_software.hpp"
#include "systemc/systemc_rig.hpp"
#include "systemc/verican_tlm.hpp"

namespace vericansim {
namespace {

using sc_core::sc_time;
constexpr auto kRead = tlm::TLM_READ_COMMAND;
constexpr auto kWrite = tlm::TLM_WRITE_COMMAND;
constexpr std::uint32_t kMcrReset = 0xD890000F;   // flexcan.md 1
constexpr std::uint32_t kConfiguration = 0x1008;  // extension page: never stalls
const sc_time kClock(125, sc_core::SC_NS);        // 8 MHz

// A module alone on a bus; its reset line; and an initiator with the test's program.
struct Bench {
  explicit Bench(TlmTiming timing) : can{"can", {.timing = timing, .clock = {.phase = 1000}}} {
    bus.set_quantum(sc_time(1, sc_core::SC_US));
    bus.attach(can);
    can.rst_n.bind(rst_n);
    can.irq.bind(irq);
  }
  // Runs a program; it must have ended after `ms`.
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

// A program waits until the buffers are cleared after reset (docs/integration.md: 256 clocks).
void settle(Master &cpu) { cpu.pause(kClock * 300 + sc_time(1, sc_core::SC_PS)); }

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

// ---- Cycle-exact only

// What a debugger sees is behind the write that is on the bus.
TEST(Debug, SeesTheStateBehindATransferUnderWay) {
  simulate([] {
    Bench bench(TlmTiming::kCycleExact);
    bench.run([](Master &cpu) {
      settle(cpu);
      cpu.write32(reg::mb(3, 2), 0x01010101);
      std::uint32_t seen = 0;
      sc_core::sc_spawn([&cpu, &seen] {
        sc_core::wait(kClock * 3 / 2);  // in the data phase
        seen = cpu.peek32(reg::mb(3, 2));
      });
      cpu.write32(reg::mb(3, 2), 0x02020202);
      EXPECT_EQ(seen, 0x02020202u);
    });
  });
}

struct Sharing {
  unsigned initiators;
  unsigned clocks;  // that 100 reads of each take
};

class Initiators : public ::testing::TestWithParam<Sharing> {};

// One alone waits for each read (two clocks); two fill each other's gaps; four take turns.
TEST_P(Initiators, ShareThePortBackToBackInTurn) {
  simulate([] {
    Bench bench(TlmTiming::kCycleExact);
    Junction junction("junction", GetParam().initiators);
    junction.output.bind(bench.can.socket);
    std::vector<unsigned> order;
    std::vector<std::unique_ptr<Master>> cpus;
    sc_time end;
    const sc_time start = kClock * 400 + sc_time(1000, sc_core::SC_PS);
    for (unsigned i = 0; i < GetParam().initiators; ++i) {
      cpus.push_back(
          std::make_unique<Master>(("cpu" + std::to_string(i)).c_str(), [&, i](Master &cpu) {
            cpu.pause(start);
            for (unsigned n = 0; n < 100; ++n) {
              EXPECT_EQ(cpu.read32(kConfiguration) & 0xFF, 64u);
              order.push_back(i);
            }
            end = cpu.local();
          }));
      cpus.back()->socket.bind(junction.input(i));
    }
    sc_core::sc_start(sc_time(1, sc_core::SC_MS));
    EXPECT_EQ(order.size(), 100u * GetParam().initiators);
    EXPECT_GE(end - start, kClock * GetParam().clocks);
    EXPECT_LE(end - start, kClock * (GetParam().clocks + 4));
    for (std::size_t i = GetParam().initiators; i < order.size(); ++i)
      EXPECT_EQ(order[i], order[i - GetParam().initiators]) << "turn " << i;
    EXPECT_TRUE(bench.can.node().ahb().checker().violations().empty());
  });
}

INSTANTIATE_TEST_SUITE_P(Numbers, Initiators,
                         ::testing::Values(Sharing{1, 200}, Sharing{2, 200}, Sharing{4, 400}),
                         [](const auto &param) {
                           return "Of" + std::to_string(param.param.initiators);
                         });

// Threads of one initiator, with bursts that are longer than one run on the bus.
TEST(Initiators, ThreadsKeepTheirDataApart) {
  simulate([] {
    Bench bench(TlmTiming::kCycleExact);
    unsigned rounds = 0;
    bench.run([&rounds](Master &cpu) {
      settle(cpu);
      const auto worker = [&cpu, &rounds](unsigned number) {
        for (unsigned round = 0; round < 20; ++round) {
          std::array<std::uint32_t, 40> out{}, in{};
          for (unsigned i = 0; i < out.size(); ++i)
            out[i] = i % 4 == 0 ? 0 : 0x01010101u * (number + 1) + 97 * i + round;
          tlm::tlm_generic_payload payload;
          sc_time delay = kClock * ((round * number) % 5);
          Master::fill(payload, kWrite, reg::mb(12 * number), out.data(), 160);
          cpu.socket->b_transport(payload, delay);
          EXPECT_TRUE(payload.is_response_ok());
          Master::fill(payload, kRead, reg::mb(12 * number), in.data(), 160);
          cpu.socket->b_transport(payload, delay);
          EXPECT_TRUE(payload.is_response_ok());
          EXPECT_EQ(in, out) << "thread " << number << " round " << round;
          ++rounds;
        }
      };
      for (unsigned number = 0; number < 4; ++number)
        sc_core::sc_spawn([worker, number] { worker(number); });
      cpu.pause(sc_time(4, sc_core::SC_MS));
      EXPECT_EQ(rounds, 80u);
    });
  });
}

// The base protocol's four phases, by the socket's adapter.
class NonBlocking : public sc_core::sc_module {
 public:
  explicit NonBlocking(const sc_core::sc_module_name &name) : sc_core::sc_module{name} {
    socket.register_nb_transport_bw(this, &NonBlocking::backward);
    SC_HAS_PROCESS(NonBlocking);
    SC_THREAD(run);
  }
  tlm_utils::simple_initiator_socket<NonBlocking> socket{"socket"};
  std::uint32_t word = 0;
  sc_time began, ended;
  tlm::tlm_response_status status = tlm::TLM_INCOMPLETE_RESPONSE;

 private:
  void run() {
    wait(kClock * 300 + sc_time(1000, sc_core::SC_PS));
    Master::fill(payload_, kRead, reg::kMcr, &word, 4);
    tlm::tlm_phase phase = tlm::BEGIN_REQ;
    sc_time delay;
    began = sc_core::sc_time_stamp();
    EXPECT_EQ(socket->nb_transport_fw(payload_, phase, delay), tlm::TLM_ACCEPTED);
  }
  tlm::tlm_sync_enum backward(tlm::tlm_generic_payload &payload, tlm::tlm_phase &phase,
                              sc_time &delay) {
    if (phase != tlm::BEGIN_RESP) return tlm::TLM_ACCEPTED;
    status = payload.get_response_status();
    ended = sc_core::sc_time_stamp() + delay;
    phase = tlm::END_RESP;
    return tlm::TLM_COMPLETED;
  }
  tlm::tlm_generic_payload payload_;
};

TEST(NonBlockingTransport, IsServedByTheSocketsAdapter) {
  simulate([] {
    Bench bench(TlmTiming::kCycleExact);
    NonBlocking cpu("cpu");
    cpu.socket.bind(bench.can.socket);
    sc_core::sc_start(sc_time(1, sc_core::SC_MS));
    EXPECT_EQ(cpu.status, tlm::TLM_OK_RESPONSE);
    EXPECT_EQ(cpu.word, kMcrReset);
    EXPECT_EQ(cpu.ended - cpu.began, kClock * 2);
  });
}

TEST(Protection, ComesWithAnExtension) {
  simulate([] {
    Bench bench(TlmTiming::kCycleExact);
    std::vector<unsigned> seen;
    bench.can.node().ahb().watch([&seen](const AhbRequest &request, const AhbResponse &) {
      if (request.htrans == AhbTrans::kNonseq) seen.push_back(request.hprot);
    });
    bench.run([](Master &cpu) {
      std::uint32_t word = 0;
      AhbProtection user(0b0001);
      tlm::tlm_generic_payload payload;
      Master::fill(payload, kRead, kConfiguration, &word, 4);
      payload.set_extension(&user);
      cpu.transport(payload);
      payload.clear_extension(&user);
      cpu.transport(payload);
    });
    EXPECT_EQ(seen, (std::vector<unsigned>{0b0001, 0b0011}));
  });
}

// ---- Mistakes in a platform

// Elaborates; expects a fatal report with this text.
void expect_fatal(const std::string &text) {
  sc_core::sc_report_handler::set_actions(sc_core::SC_FATAL, sc_core::SC_THROW);
  try {
    sc_core::sc_start(sc_time(1, sc_core::SC_US));
    ADD_FAILURE() << "nothing was said";
  } catch (const sc_core::sc_report &report) {
    EXPECT_NE(std::string{report.get_msg()}.find(text), std::string::npos) << report.get_msg();
  }
}

TEST(Elaboration, LooselyTimedWithoutABusIsFatal) {
  simulate([] {
    VericanTlm can("can", {.timing = TlmTiming::kLooselyTimed});
    Master cpu("cpu");
    cpu.socket.bind(can.socket);
    expect_fatal("needs CanBus::attach()");
  });
}

TEST(Elaboration, PinsAndLooselyTimedOnOneBusIsFatal) {
  simulate([] {
    CanBus bus("bus");
    VericanTlm can("can", {.timing = TlmTiming::kLooselyTimed});
    Master cpu("cpu");
    cpu.socket.bind(can.socket);
    bus.attach(can);
    bus.add_pins("other");
    expect_fatal("cannot share a bus");
  });
}

}  // namespace
}  // namespace vericansim
