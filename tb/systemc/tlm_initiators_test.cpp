// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Several initiators and threads at one socket; the non-blocking interface; HPROT; and the mistakes
// that elaboration finds.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "systemc/socket_bench.hpp"

namespace vericansim {
namespace {

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

void PrintTo(const Sharing &sharing, std::ostream *out) { *out << sharing.initiators; }

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

// A call at the very instant of an edge is taken by the next one, whether the edge has been in this
// instant or is still to come.
TEST(Initiators, ACallAtTheInstantOfAnEdgeIsTakenByTheNext) {
  simulate([] {
    sc_core::sc_clock clock("clock", kClock);
    DeltaLag lag("lag", clock, 5);
    CanBus bus("bus");
    VericanTlm can("can", {});
    bus.attach(can);
    can.clk.bind(lag.out());
    Master cpu("cpu", [](Master &self) {
      for (int deltas = 0; deltas < 10; ++deltas) {
        self.pause(kClock * 10);
        for (int i = 0; i < deltas; ++i) self.wait(sc_core::SC_ZERO_TIME);
        std::uint32_t word = 0;
        EXPECT_EQ(self.transport(kRead, kConfiguration, &word, 4).taken, kClock * 2) << deltas;
      }
    });
    cpu.socket.bind(can.socket);
    sc_core::sc_start(sc_time(1, sc_core::SC_MS));
    EXPECT_TRUE(cpu.finished);
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
