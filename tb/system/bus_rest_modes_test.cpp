// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// While the software of a node stops, sets up and starts it, at any clock, its engine may rest and
// the registers move, or the other way round: in every clock the node is where the whole model is,
// which has no short cuts and is clocked every time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>

#include "Vcan_ahb64.h"
#include "Vcan_ahb64___024root.h"
#include "Vcan_ahb_time.h"
#include "Vcan_ahb_time___024root.h"
#include "bus/bus.hpp"
#include "harness/bus_trail.hpp"
#include "model/registers.hpp"
#include "node/host.hpp"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/model_pins.hpp"
#include "node/rtl_node.hpp"

namespace vericansim {
namespace {

struct Clocking {
  const char *name;
  unsigned megahertz;
  BitTiming timing;
  bool with_time;
};
void PrintTo(const Clocking &clocking, std::ostream *out) { *out << clocking.name; }

constexpr Clocking kClockings[] = {
    {"Prescaler1", 8, {.prescaler = 1, .prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 2}, false},
    {"Prescaler5", 50, {.prescaler = 5, .prop = 3, .ps1 = 3, .ps2 = 3, .sjw = 3}, false},
    {"Prescaler10", 80, {.prescaler = 10, .prop = 2, .ps1 = 3, .ps2 = 2, .sjw = 2}, false},
    {"WithTheTimeUnit", 40, {.prescaler = 5, .prop = 2, .ps1 = 3, .ps2 = 2, .sjw = 2}, true},
};

// A core as one model.
template <typename Whole>
class WholeNode final : public RtlNode {
 public:
  WholeNode(const std::string &name, const ClockConfig &clock) : RtlNode{name, clock, 64} {
    reset();
  }
  ~WholeNode() override { whole_.final(); }

  void reset() override {
    ahb().reset();
    show(true);
    whole_.can_rx_i = 1;
    whole_.hresetn = 0;
    for (int i = 0; i < 4; ++i) edge();
    whole_.hresetn = 1;
    edge();
  }

  void clock(Level rx) override {
    whole_.can_rx_i = static_cast<std::uint8_t>(rx);
    const bool active = ahb().active();
    if (active) {
      show(whole_.hreadyout != 0);
      if (whole_.hready != whole_.hreadyout) show(whole_.hreadyout != 0);
    }
    const AhbResponse response{whole_.hrdata, whole_.hreadyout != 0, whole_.hresp != 0};
    edge();
    if (active) {
      ahb().clock(response);
      if (!ahb().active()) show(true);
    }
    drive(static_cast<Level>(whole_.can_tx_o));
    after_edge();
  }

  [[nodiscard]] AhbResult peek(const AhbTransfer &) override {
    throw std::logic_error("read by real transfers only");
  }
  void request_stop(bool stop) override { whole_.stop_req_i = stop; }
  [[nodiscard]] std::uint64_t trace() const override { return whole_.trace_o; }
  [[nodiscard]] std::uint8_t irq_lines() const override { return model_irq_lines(whole_); }

 private:
  void show(bool ready) {
    show_request(whole_, ahb().request());
    whole_.hready = ready;
    whole_.eval();
  }
  void edge() { rising_edge(whole_, whole_.hclk); }

  SerialContext context_;
  Whole whole_{&context_, "whole"};
};

std::unique_ptr<RtlNode> create(const Clocking &clocking, unsigned n, bool whole) {
  const ClockConfig clock{.frequency_hz = clocking.megahertz * 1e6};
  const std::string name = fmt::format("node{}", n);
  if (whole && clocking.with_time) return std::make_unique<WholeNode<Vcan_ahb_time>>(name, clock);
  if (whole) return std::make_unique<WholeNode<Vcan_ahb64>>(name, clock);
  return clocking.with_time ? RtlNode::create_with_time(name, clock) : RtlNode::create(name, clock);
}

// Two nodes that talk, and the software of one of them.
class Stage {
 public:
  Stage(const Clocking &clocking, bool whole)
      : clock_{static_cast<Time>(kSecond / (clocking.megahertz * 1'000'000LL))} {
    // Several, so that a frame that waits gives way to another one.
    const HostConfig config{.timing = clocking.timing, .tx_buffers = 4};
    for (unsigned i = 0; i < 2; ++i) {
      nodes_[i] = create(clocking, i, whole);
      bus_.add(*nodes_[i]);
      hosts_[i] = std::make_unique<Host>(*nodes_[i], config);
      hosts_[i]->start();
    }
    bus_.run_for(200 * kMicrosecond);
    ctrl_ = nodes_[0]->read32(reg::kCtrl);
  }

  Trail run(unsigned changes) {
    for (unsigned i = 0; i < changes; ++i) {
      if (i % 2 == 0) change();
      for (const auto &host : hosts_)
        if (host->ready() && random_() % 2 == 0)
          host->send({.id = static_cast<std::uint32_t>(random_() & 0x7FF), .dlc = 1});
      watch(30 + random_() % 300);
    }
    return std::move(trail_);
  }
  [[nodiscard]] std::uint64_t edges_passed() const { return bus_.edges_passed(); }

 private:
  void write(std::uint32_t address, std::uint32_t data) {
    nodes_[0]->ahb().submit({.address = address, .write = true, .data = data});
  }

  // What of it is allowed in freeze mode alone is ignored elsewhere.
  void change() {
    const std::uint32_t mcr = reg::kMcrFrz | reg::kMcrSupv | reg::kMcrWrnEn | 0xF;
    switch (random_() % 10) {
      case 0:
      case 1: write(reg::kMcr, mcr | reg::kMcrHalt); break;
      case 2:
      case 3: write(reg::kMcr, mcr); break;
      case 4: write(reg::kMcr, mcr | reg::kMcrMdis); break;
      case 5:
        write(reg::kCtrl, ctrl_ ^ (random_() % 2 == 0 ? reg::kCtrlLpb : reg::kCtrlLom));
        break;
      case 6: write(reg::kCtrl, ctrl_ ^ (random_() % 2 == 0 ? reg::kCtrlSmp : 1u << 24)); break;
      case 7: write(reg::kEcr, random_() % 256); break;
      default: write(reg::kTimer, random_() % 0x10000); break;
    }
  }

  void watch(unsigned clocks) {
    for (unsigned i = 0; i < clocks; ++i) {
      bus_.run_for(clock_);
      trail_.push_back(fmt::format("{:X} {:X} {:X}", nodes_[0]->trace(), nodes_[1]->trace(),
                                   nodes_[0]->irq_lines()));
    }
    for (const std::uint32_t address : {reg::kMcr, reg::kCtrl, reg::kTimer, reg::kEcr})
      trail_.push_back(fmt::format("{:X}", nodes_[0]->read32(address)));
  }

  Time clock_;
  std::mt19937 random_{11};
  Trail trail_;
  std::array<std::unique_ptr<RtlNode>, 2> nodes_;
  std::array<std::unique_ptr<Host>, 2> hosts_;
  std::uint32_t ctrl_ = 0;
  Bus bus_;
};

class RestInModes : public ::testing::TestWithParam<Clocking> {};

TEST_P(RestInModes, ChangesNoClock) {
  constexpr unsigned kChanges = 1000;
  Stage resting{GetParam(), false}, clocked{GetParam(), true};
  const Trail got = resting.run(kChanges), due = clocked.run(kChanges);
  EXPECT_TRUE(kPlainEdges || resting.edges_passed() > 10'000);
  EXPECT_EQ(clocked.edges_passed(), 0u);
  EXPECT_EQ(first_difference(got, due), "");
}

INSTANTIATE_TEST_SUITE_P(Clockings, RestInModes, ::testing::ValuesIn(kClockings),
                         [](const auto &each) { return std::string{each.param.name}; });

}  // namespace
}  // namespace vericansim
