// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A host side whose passes over the buffers (TransmitScan) and received bytes (ByteStore) are left
// out has, whenever it is evaluated, the same bits in every member of the model as one that does
// each clock of them.
#include <gtest/gtest.h>

#include <cstring>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "Vcan_host16.h"
#include "Vcan_host16___024root.h"
#include "Vcan_host32.h"
#include "Vcan_host32___024root.h"
#include "Vcan_host64.h"
#include "Vcan_host64___024root.h"
#include "Vcan_host64_time.h"
#include "Vcan_host64_time___024root.h"
#include "bus/bus.hpp"
#include "harness/model_members.hpp"
#include "model/registers.hpp"
#include "node/host.hpp"
#include "node/model_edge.hpp"
#include "node/model_pins.hpp"
#include "node/quiet_engine.hpp"
#include "node/rtl_node.hpp"
#include "node/split_core.hpp"
#include "node/timed_engine.hpp"

namespace vericansim {
namespace {

// Two cores on the same pins: one leaves passes and bytes out, the other does them.
template <typename Model, typename Ports = AhbPorts, typename Engine = Vcan_core>
class ScanTwins : public RtlNode {
 public:
  ScanTwins(const std::string &name, const ClockConfig &clock, unsigned num_mb, bool bytes)
      : RtlNode{name, clock, num_mb}, bytes_{bytes} {
    short_.let_work_rest(true, bytes);
    full_.let_work_rest(false, false);
    reset();
    members_.emplace(*short_.host().rootp, *full_.host().rootp);
  }

  void reset() override {
    show({}, true);
    each([](auto &core) {
      core.engine().can_rx_i = 1;
      core.reset(true);
      for (int i = 0; i < 4; ++i) core.edge();
      core.reset(false);
      core.settle();
      core.edge();
    });
  }

  void clock(Level rx) override {
    each([rx](auto &core) { core.engine().can_rx_i = static_cast<std::uint8_t>(rx); });
    const bool active = ahb().active();
    if (active) {
      show(ahb().request(), full_.host().hreadyout != 0);
      each([](auto &core) { core.settle(); });
      if (full_.host().hready != full_.host().hreadyout) {
        show(ahb().request(), full_.host().hreadyout != 0);
        each([](auto &core) { core.settle(); });
      }
    }
    const auto &host = full_.host();
    if (active && host.hrdata != short_.host().hrdata) ++differences_;
    const AhbResponse response{host.hrdata, host.hreadyout != 0, host.hresp != 0};
    const bool looked = random_() % 64 == 0;  // in the middle of a pass, too
    if (looked) each([](auto &core) { core.touch(); });
    if (looked && bytes_) compare();  // between the two clocks of a byte, too
    each([](auto &core) { core.edge(); });
    if (looked || !short_.resting()) compare();
    left_out_ += short_.resting() && !full_.resting();
    if (short_.engine().trace_o != full_.engine().trace_o) ++differences_;
    if (model_irq_lines(std::as_const(short_).host()) != irq_lines()) ++differences_;
    if (active) {
      ahb().clock(response);
      if (!ahb().active()) {
        show(ahb().request(), true);
        each([](auto &core) { core.touch(); });
      }
    }
    drive(static_cast<Level>(full_.engine().can_tx_o));
    after_edge();
  }

  [[nodiscard]] AhbResult peek(const AhbTransfer &) override {
    throw std::logic_error("the twins are compared by real transfers only");
  }
  void request_stop(bool) override { throw std::logic_error("the twins are not stopped"); }
  [[nodiscard]] std::uint64_t trace() const override { return full_.engine().trace_o; }
  [[nodiscard]] std::uint8_t irq_lines() const override { return model_irq_lines(full_.host()); }
  [[nodiscard]] unsigned differences() const { return differences_; }
  [[nodiscard]] unsigned left_out() const { return left_out_; }

 private:
  using Root = std::remove_reference_t<decltype(*std::declval<Model &>().rootp)>;

  template <typename Do>
  void each(Do &&act) {
    act(short_);
    act(full_);
  }
  void show(const AhbRequest &request, bool ready) {
    each([&](auto &core) {
      show_request(core.host(), request);
      core.host().hready = ready;
    });
  }
  void compare() {
    const Root &mine = *short_.host().rootp, &other = *full_.host().rootp;
    if (members_ && !(bytes_ ? same_buffers(mine, other) : members_->same(mine, other)))
      ++differences_;
  }
  // A host side that does not wake for a byte does not see what else it would have seen then: the
  // identifier and the timer, which mean nothing to it.
  static bool same_buffers(const Root &mine, const Root &other) {
    const auto same = [](const auto &a, const auto &b) {
      return std::memcmp(&a, &b, sizeof(a)) == 0;
    };
    return same(mine.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem,
                other.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem) &&
           same(mine.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem,
                other.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem) &&
           same(mine.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_smb__DOT__count_q,
                other.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_smb__DOT__count_q) &&
           same(mine.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_smb__DOT__byte_q,
                other.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_smb__DOT__byte_q);
  }

  SplitCore<Model, Ports, Engine> short_, full_;
  std::optional<ModelMembers<Root>> members_;
  std::mt19937 random_{7};
  bool bytes_;
  unsigned differences_ = 0;
  unsigned left_out_ = 0;
};

// Writes and reads of the buffers that the software leaves alone, over and over.
void disturb(RtlNode &node, std::mt19937 &random) {
  constexpr std::uint32_t kCodes[] = {0x0, 0x0, 0x4, 0x8, 0x8, 0x9, 0xA, 0xC};
  const unsigned n = 2 + random() % (node.num_mb() - 4);
  const std::uint32_t format = (random() % 2 != 0 ? 0x00600000u : 0) | random() % 2 << 20;
  if (random() % 3 == 0) node.ahb().submit({.address = reg::mb(random() % node.num_mb())});
  node.ahb().submit(
      {.address = reg::mb(n, 1), .write = true, .data = static_cast<std::uint32_t>(random())});
  node.ahb().submit(
      {.address = reg::mb(n), .write = true, .data = kCodes[random() % 8] << 24 | format});
}

struct ScanCase {
  const char *name;
  std::uint32_t mcr;  // bits set besides those of the software
  bool lowest_first;
};
void PrintTo(const ScanCase &each, std::ostream *out) { *out << each.name; }

constexpr ScanCase kCases[] = {
    {"LowestBufferFirst", 0, true}, {"LowestIdFirst", 0, false}, {"Priorities", 1u << 13, false},
    {"FewerBuffers", 0x100, false}, {"Fifo", 1u << 29, false},
};

template <typename Model, typename Ports = AhbPorts, typename Engine = Vcan_core>
void run(const ScanCase &each, unsigned num_mb, bool bytes = false) {
  Bus bus;
  ScanTwins<Model, Ports, Engine> a{"a", {.error_ppm = 100}, num_mb, bytes};
  const auto b = RtlNode::create("b", {.error_ppm = -150, .phase = 30'000}, 16);
  bus.add(a);
  bus.add(*b);
  HostConfig config;
  config.timing = {.prescaler = 1, .prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 2};
  config.tx_buffers = 2;
  config.lowest_buffer_first = each.lowest_first;
  config.filters = {{}, {}};
  Host first{a, config};
  config.filters = {};
  Host second{*b, config};
  first.start_and_wait();
  second.start_and_wait();
  const std::uint32_t mcr = a.read32(reg::kMcr);
  const std::uint32_t fewer = (each.mcr & 0x100) != 0 ? 4 : 0;
  a.write32(reg::kMcr, mcr | reg::kMcrHalt);
  bus.run_for(300 * kMicrosecond);
  a.write32(reg::kMcr, ((mcr | reg::kMcrHalt) - fewer) | (each.mcr & ~0x100u));
  a.write32(reg::kMcr, (mcr - fewer) | (each.mcr & ~0x100u));
  std::mt19937 random{3};
  for (int i = 0; i < 1000; ++i) {
    bus.run_for(random() % 120 * kMicrosecond);
    if (i % 4 == 0) first.send({.id = 0x100u + static_cast<unsigned>(i), .dlc = 8});
    if (i % 4 == 2) second.send({.id = 0x80u + static_cast<unsigned>(i), .dlc = 8});
    disturb(a, random);
  }
  EXPECT_EQ(a.differences(), 0u);
  if (!kPlainEdges) EXPECT_GT(a.left_out(), 1000u);
  EXPECT_GT(second.stats().received, 20u);
}

class TransmitScanTest : public ::testing::TestWithParam<ScanCase> {};

TEST_P(TransmitScanTest, SameMembersWith16Buffers) { run<Vcan_host16>(GetParam(), 16); }
TEST_P(TransmitScanTest, SameMembersWith32Buffers) { run<Vcan_host32>(GetParam(), 32); }
TEST_P(TransmitScanTest, SameMembersWith64Buffers) { run<Vcan_host64>(GetParam(), 64); }
TEST_P(TransmitScanTest, SameMembersWithTheTimeUnit) {
  run<Vcan_host64_time, AhbTimePorts, TimedEngine>(GetParam(), 64);
}

TEST_P(TransmitScanTest, SameBuffersWithBytesLeftOut) { run<Vcan_host32>(GetParam(), 32, true); }

// A member that a change of the RTL has renamed or removed turns a short cut off, silently.
template <typename Model, typename Ports, typename Engine>
void expect_short_cuts() {
  using Root = std::remove_reference_t<decltype(*std::declval<Model &>().rootp)>;
  SerialContext context;
  Model model{&context, "host"};
  Engine engine{&context, "engine"};
  const ModelContext of_both{context};
  EXPECT_TRUE(TransmitScan<Root>::in_force());
  EXPECT_TRUE((ByteStore<Root, Ports>::in_force()));
  EXPECT_GT(HostImage<Root>::left_out(*model.rootp), sizeof(Root) / 3);
  EXPECT_TRUE(Ports::in_block(engine, *model.rootp));
  EXPECT_TRUE(QuietEngine::in_force<Engine>());
  EXPECT_TRUE(QuietEngine::judges<Engine>());
  if constexpr (kHasTimeUnit<Engine>) EXPECT_TRUE(Engine::in_force());
}

TEST(ShortCutsTest, AreInForceInEachModel) {
  if (kPlainEdges) GTEST_SKIP() << "models without short cuts";
  expect_short_cuts<Vcan_host16, AhbPorts, Vcan_core>();
  expect_short_cuts<Vcan_host32, AhbPorts, Vcan_core>();
  expect_short_cuts<Vcan_host64, AhbPorts, Vcan_core>();
  expect_short_cuts<Vcan_host64_time, AhbTimePorts, TimedEngine>();
}

INSTANTIATE_TEST_SUITE_P(Cases, TransmitScanTest, ::testing::ValuesIn(kCases),
                         [](const auto &each) { return std::string{each.param.name}; });

}  // namespace
}  // namespace vericansim
