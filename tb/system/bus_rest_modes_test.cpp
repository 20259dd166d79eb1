// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// While the software of a node stops, sets up and starts it, at any clock, its engine may rest and
// the registers move, or the other way round: in every clock the node is where one is that never
// rests.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <random>
#include <string>

#include "bus/bus.hpp"
#include "harness/bus_trail.hpp"
#include "model/registers.hpp"
#include "node/host.hpp"
#include "node/model_edge.hpp"
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

// Two nodes that talk, and the software of one of them.
class Stage {
 public:
  Stage(const Clocking &clocking, bool rest)
      : clock_{static_cast<Time>(kSecond / (clocking.megahertz * 1'000'000LL))} {
    bus_.let_rest(rest);
    for (unsigned i = 0; i < 2; ++i) {
      const ClockConfig clock{.frequency_hz = clocking.megahertz * 1e6};
      const std::string name = fmt::format("node{}", i);
      nodes_[i] = clocking.with_time ? RtlNode::create_with_time(name, clock)
                                     : RtlNode::create(name, clock, 16);
      bus_.add(*nodes_[i]);
      hosts_[i] = std::make_unique<Host>(*nodes_[i], HostConfig{.timing = clocking.timing});
      hosts_[i]->start();
    }
    bus_.run_for(200 * kMicrosecond);
    ctrl_ = nodes_[0]->peek({.address = reg::kCtrl}).data;
  }

  Trail run(unsigned changes) {
    for (unsigned i = 0; i < changes; ++i) {
      for (const auto &host : hosts_)
        if (host->ready() && random_() % 2 == 0) host->send({.id = random_() & 0x7FF, .dlc = 1});
      change();
      watch(30 + random_() % 600);
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
      trail_.push_back(fmt::format("{:X}", nodes_[0]->peek({.address = address}).data));
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
  constexpr unsigned kChanges = 400;
  Stage resting{GetParam(), true}, clocked{GetParam(), false};
  const Trail got = resting.run(kChanges), due = clocked.run(kChanges);
  EXPECT_TRUE(kPlainEdges || resting.edges_passed() > 10'000);
  EXPECT_EQ(clocked.edges_passed(), 0u);
  EXPECT_EQ(first_difference(got, due), "");
}

INSTANTIATE_TEST_SUITE_P(Clockings, RestInModes, ::testing::ValuesIn(kClockings),
                         [](const auto &each) { return std::string{each.param.name}; });

}  // namespace
}  // namespace vericansim
