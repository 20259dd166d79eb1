// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SplitCore, engine and host side as two models, is the whole core in every clock: same pins, same
// trace.
#include "node/split_core.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "Vcan_ahb64.h"
#include "Vcan_ahb64___024root.h"
#include "Vcan_ahb_time.h"
#include "Vcan_ahb_time___024root.h"
#include "Vcan_host64.h"
#include "Vcan_host64___024root.h"
#include "Vcan_host64_time.h"
#include "Vcan_host64_time___024root.h"
#include "bus/bus.hpp"
#include "bus/faults.hpp"
#include "model/registers.hpp"
#include "node/host.hpp"
#include "node/model_context.hpp"
#include "node/model_pins.hpp"
#include "node/rtl_node.hpp"
#include "node/timed_engine.hpp"
#include "verican/verican_regs.h"

namespace vericansim {
namespace {

// A node that runs the whole model and the split one on the same pins and counts differing clocks.
template <typename Whole, typename Split>
class Twins : public RtlNode {
 public:
  Twins(const std::string &name, const ClockConfig &clock) : RtlNode{name, clock, 64} { reset(); }
  ~Twins() override { whole_.final(); }

  void reset() override {
    show({}, true);
    whole_.can_rx_i = 1;
    split_.engine().can_rx_i = 1;
    whole_.hresetn = 0;
    split_.reset(true);
    for (int i = 0; i < 4; ++i) edge();
    whole_.hresetn = 1;
    split_.reset(false);
    settle();
    edge();
  }

  void clock(Level rx) override {
    whole_.can_rx_i = static_cast<std::uint8_t>(rx);
    split_.engine().can_rx_i = static_cast<std::uint8_t>(rx);
    const bool active = ahb().active();
    if (active) {
      show(ahb().request(), whole_.hreadyout != 0);
      settle();
      if (whole_.hready != whole_.hreadyout) {
        show(ahb().request(), whole_.hreadyout != 0);
        settle();
      }
      check("HRDATA", whole_.hrdata, split_.host().hrdata);  // live: TIMER counts with the engine
      compare();
    }
    const AhbResponse response{whole_.hrdata, whole_.hreadyout != 0, whole_.hresp != 0};
    edge();
    compare();
    if (active) {
      ahb().clock(response);
      if (!ahb().active()) {
        show(ahb().request(), true);
        split_.touch();
      }
    }
    drive(static_cast<Level>(whole_.can_tx_o));
    after_edge();
  }

  [[nodiscard]] AhbResult peek(const AhbTransfer &) override {
    throw std::logic_error("the twins are compared by real transfers only");
  }

  void request_stop(bool stop) override {
    whole_.stop_req_i = stop;
    split_.host().stop_req_i = stop;
    split_.touch();
  }

  [[nodiscard]] std::uint64_t trace() const override { return whole_.trace_o; }
  [[nodiscard]] std::uint8_t irq_lines() const override { return model_irq_lines(whole_); }
  [[nodiscard]] unsigned differences() const { return differences_; }
  [[nodiscard]] const std::string &first() const { return first_; }

 private:
  template <typename Model>
  static void show_to(Model &m, const AhbRequest &r, bool ready) {
    show_request(m, r);
    m.hready = ready;
  }
  void show(const AhbRequest &request, bool ready) {
    show_to(whole_, request, ready);
    show_to(split_.host(), request, ready);
  }
  void settle() {
    whole_.eval();
    split_.settle();
  }
  void edge() {
    rising_edge(whole_, whole_.hclk);
    split_.edge();
  }

  void compare() {
    const auto &host = split_.host();
    const auto &engine = split_.engine();
    check("HREADYOUT", whole_.hreadyout, host.hreadyout);
    check("HRESP", whole_.hresp, host.hresp);
    check("interrupts", model_irq_lines(whole_), model_irq_lines(host));
    check("can_tx_o", whole_.can_tx_o, engine.can_tx_o);
    check("trace_o", whole_.trace_o, engine.trace_o);
    check("irq_time_o", whole_.irq_time_o, host.irq_time_o);
    check("time_out_o", whole_.time_out_o, time_out_of(engine) ? 1 : 0);
  }
  void check(const char *what, std::uint64_t whole, std::uint64_t split) {
    if (whole == split) return;
    if (differences_++ != 0) return;
    first_ = std::string{what} + " in cycle " + std::to_string(cycles()) + ": whole " +
             std::to_string(whole) + ", split " + std::to_string(split);
  }

  SerialContext context_;
  Whole whole_{&context_, "whole"};
  Split split_;
  unsigned differences_ = 0;
  std::string first_;
};

using TwinNode = Twins<Vcan_ahb64, SplitCore<Vcan_host64>>;
using TimeTwinNode = Twins<Vcan_ahb_time, SplitCore<Vcan_host64_time, AhbTimePorts, TimedEngine>>;

Frame random_frame(std::mt19937 &random, std::uint32_t top) {
  Frame f{.id = static_cast<std::uint32_t>(top << 8 | (random() & 0xFF)),
          .dlc = static_cast<std::uint8_t>(random() % 16)};
  f.remote = random() % 8 == 0;
  for (unsigned i = 0; i < f.payload_size(); ++i) f.data[i] = static_cast<std::uint8_t>(random());
  return f;
}

struct SplitCase {
  const char *name;
  unsigned prescaler;
  double noise;  // probability that a bit is flipped at a node
};

class SplitCoreTest : public ::testing::TestWithParam<SplitCase> {};

template <typename Twin, typename Work>
void compare_on_bus(const SplitCase &each, Work work) {
  Bus bus;
  HostConfig config;
  config.timing = {.prescaler = each.prescaler, .prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 2};
  config.tx_buffers = 4;
  Twin a{"a", {.error_ppm = 100}};
  Twin b{"b", {.error_ppm = -150, .phase = 30'000}};
  bus.add(a);
  bus.add(b);
  NoiseFault noise{{.per_bit = each.noise, .window = {.from = kMillisecond}}};
  bus.add(noise);
  Host first{a, config};
  Host second{b, config};
  first.start();
  second.start();
  std::mt19937 random{1};
  for (int i = 0; i < 150; ++i) {
    first.send(random_frame(random, 2));
    second.send(random_frame(random, 3));
  }
  for (int i = 0; i < 400; ++i) {
    bus.run_for(100 * kMicrosecond);
    work(i % 2 == 0 ? a : b, random);
  }
  first.check();
  second.check();
  EXPECT_GT(first.stats().received + second.stats().received,
            5u);  // the noisiest bus carries little
  EXPECT_EQ(a.differences(), 0u) << a.first();
  EXPECT_EQ(b.differences(), 0u) << b.first();
}

TEST_P(SplitCoreTest, IsTheWholeCoreInEveryClock) {
  compare_on_bus<TwinNode>(GetParam(), [](TwinNode &, std::mt19937 &) {});
}

// The time unit's registers and stamps are read, and written, at any time (TM-122).
TEST_P(SplitCoreTest, IsTheWholeCoreWithTheTimeUnit) {
  constexpr std::uint32_t kWords = (VERICAN_TEXTHI_OFFSET - VERICAN_TCAP_OFFSET) / 4 + 1;
  unsigned changes = 0;
  std::uint32_t last = 0;
  compare_on_bus<TimeTwinNode>(GetParam(), [&](TimeTwinNode &node, std::mt19937 &random) {
    for (int n = 0; n < 4; ++n) {
      const std::uint32_t word = random() % 3;
      const std::uint32_t address = VERICAN_TCAP_OFFSET + 4 * (random() % kWords);
      if (word == 0) node.write32(address, random());
      changes += std::exchange(last, node.read32(address)) != last;
      node.read32(VERICAN_STAMPLO_OFFSET(0) + 4 * (random() % 128));
    }
    // The upper half alone changes on the engine's side, a clock after the lower one.
    node.write32(VERICAN_TIMEHI_OFFSET, random());
    node.read32(VERICAN_TIMELO_OFFSET);
    node.read32(VERICAN_TIMEHI_OFFSET);
  });
  EXPECT_GT(changes, 100u);
}

// Stop mode over and over, with and without the filter: the host side sleeps in it while the bus
// moves, and has to see the edge in the same clock as the whole core.
TEST(SplitCoreStop, WakesInTheSameClock) {
  constexpr std::uint32_t kSlfWak = 1u << 22, kWakSrc = 1u << 19, kWakMsk = 1u << 26;
  for (const std::uint32_t filter : {0u, kWakSrc}) {
    Bus bus;
    TwinNode a{"a", {.error_ppm = 100}};
    TwinNode b{"b", {.error_ppm = -150, .phase = 30'000}};
    bus.add(a);
    bus.add(b);
    HostConfig config;
    config.timing = {.prescaler = 1, .prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 2};
    Host host{b, config};
    bus.run_for(100 * kMicrosecond);
    a.write32(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | kSlfWak);
    bus.run_for(10 * kMicrosecond);
    a.write32(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | filter | kSlfWak | kWakMsk | 0x3F);
    a.write32(reg::kCtrl, 0x00490002);
    a.write32(reg::kMcr, filter | kSlfWak | kWakMsk | 0x3F);
    host.start();
    unsigned woken = 0;
    for (int i = 0; i < 40; ++i) {
      bus.run_for(300 * kMicrosecond + i * 1234 * kNanosecond);
      a.request_stop(true);
      bus.run_for(200 * kMicrosecond);
      host.send({.id = 0x100u + i, .dlc = 1});
      bus.run_for(200 * kMicrosecond);
      woken += (a.irq_lines() & kIrqWake) != 0;
      a.write32(reg::kEsr, 1);
      a.request_stop(false);
    }
    EXPECT_EQ(woken, 40u);
    EXPECT_EQ(a.differences(), 0u) << a.first();
    EXPECT_EQ(b.differences(), 0u) << b.first();
  }
}

// The counters in the trace, each bit of them.
TEST(SplitCoreCounters, ShowInTheSameClock) {  // FX-ECR.TEC, FX-ECR.REC
  Bus bus;
  TwinNode node{"a", {}};
  bus.add(node);
  bus.run_for(100 * kMicrosecond);
  node.write32(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | 0x3F);
  bus.run_for(10 * kMicrosecond);
  for (unsigned bit = 0; bit < 16; ++bit) {
    node.write32(reg::kEcr, 1u << bit);
    bus.run_for(kMicrosecond);
    EXPECT_EQ(decode_trace(node.trace()).tec, 1u << bit & 0xFF);
    EXPECT_EQ(decode_trace(node.trace()).rec, 1u << bit >> 8);
    node.write32(reg::kEcr, 0);
  }
  EXPECT_EQ(node.differences(), 0u) << node.first();
}

INSTANTIATE_TEST_SUITE_P(Cases, SplitCoreTest,
                         ::testing::Values(SplitCase{"Saturated", 1, 0},
                                           SplitCase{"Noisy", 1, 0.002},
                                           SplitCase{"VeryNoisy", 1, 0.02},
                                           SplitCase{"SlowerBits", 3, 0.001}),
                         [](const auto &each) { return each.param.name; });

}  // namespace
}  // namespace vericansim
