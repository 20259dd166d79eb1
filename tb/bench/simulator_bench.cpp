// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Speed of the simulator: whole cores on a saturated bus of 1 Mbit/s, and the kernel alone.
#include <benchmark/benchmark.h>

#include <initializer_list>
#include <memory>
#include <vector>

#include "bench/saturated_bus.hpp"
#include "bus/faults.hpp"
#include "node/core_node.hpp"
#include "node/remote_node.hpp"

namespace vericansim {
namespace {

// Arguments: nodes, MHz, 1 = every node has its own clock. One iteration is 2 ms of simulated time.
void run_saturated(benchmark::State &state, bool with_time) {
  SaturatedBus net(static_cast<unsigned>(state.range(0)), static_cast<unsigned>(state.range(1)),
                   state.range(2) != 0, with_time);
  constexpr Time kSlice = 2 * kMillisecond;
  const std::uint64_t cycles = net.cycles();
  const std::uint64_t received = net.received();
  for (auto _ : state) net.run_for(kSlice);
  const auto simulated =
      static_cast<double>(kSlice) * 1e-12 * static_cast<double>(state.iterations());
  state.counters["node_cycles/s"] =
      benchmark::Counter(static_cast<double>(net.cycles() - cycles), benchmark::Counter::kIsRate);
  state.counters["real_time"] = benchmark::Counter(simulated, benchmark::Counter::kIsRate);
  state.counters["frames/ms"] = static_cast<double>(net.received() - received) /
                                static_cast<double>(state.range(0) - 1) / simulated / 1e3;
}
void saturated_bus(benchmark::State &state) { run_saturated(state, false); }
BENCHMARK(saturated_bus)
    ->ArgNames({"nodes", "MHz", "drift"})
    ->ArgsProduct({{2, 4, 8}, {8, 16, 50, 80}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

// The same with the time unit (TM-126).
void bus_with_time(benchmark::State &state) { run_saturated(state, true); }
BENCHMARK(bus_with_time)
    ->ArgNames({"nodes", "MHz", "drift"})
    ->ArgsProduct({{2}, {8, 16, 50, 80}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

// A node that does nothing: what is left is the kernel.
class EmptyNode : public Node {
 public:
  explicit EmptyNode(const ClockConfig &clock) : Node{"empty", clock} {}
  void clock(Level rx) override {
    // One change of the level in 64 clocks, more than a real node makes at 16 clocks a bit.
    if ((++count_ & 63) == 0) drive(!tx());
    benchmark::DoNotOptimize(rx);
  }

 private:
  unsigned count_ = 0;
};

// Arguments: nodes, 1 = every node has its own clock.
void kernel_alone(benchmark::State &state) {
  Bus bus;
  std::vector<std::unique_ptr<EmptyNode>> nodes;
  for (int i = 0; i < state.range(0); ++i) {
    nodes.push_back(
        std::make_unique<EmptyNode>(ClockConfig{.error_ppm = state.range(1) * 10.0 * i}));
    bus.add(*nodes.back());
  }
  for (auto _ : state) bus.run_for(kMillisecond);
  state.counters["node_cycles/s"] = benchmark::Counter(
      8000.0 * static_cast<double>(state.range(0)) * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate);
}
BENCHMARK(kernel_alone)
    ->ArgNames({"nodes", "drift"})
    ->ArgsProduct({{2, 8, 32}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

// The engine alone, idle bus: the floor of a Verilated node.
void engine_alone(benchmark::State &state) {
  CoreNode node{"engine"};
  node.start();
  for (auto _ : state) {
    for (int i = 0; i < 1000; ++i) node.clock(Level::kRecessive);
  }
  state.counters["node_cycles/s"] = benchmark::Counter(
      1000.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(engine_alone)->Unit(benchmark::kMicrosecond);

// The whole core, idle bus, no accesses.
void core_alone(benchmark::State &state) {
  const auto node = RtlNode::create("core", {}, static_cast<unsigned>(state.range(0)));
  Host host{*node, {}};
  host.start_and_wait();
  for (auto _ : state) {
    for (int i = 0; i < 1000; ++i) node->clock(Level::kRecessive);
  }
  state.counters["node_cycles/s"] = benchmark::Counter(
      1000.0 * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(core_alone)->ArgName("buffers")->Arg(16)->Arg(64)->Unit(benchmark::kMicrosecond);

// Two nodes without a processor at 16 clocks a bit. Argument: reads of a host in 10 ms, 0 to 60.
void remote_nodes(benchmark::State &state) {
  const BitTiming timing{.prescaler = 1, .prop = 7, .ps1 = 4, .ps2 = 4, .sjw = 2};
  CoreNode host{"host", {.timing = timing}};
  const auto config = RemoteConfig::profile("full");
  const auto a = RemoteNode::create("a", config, 3, timing);
  const auto b = RemoteNode::create("b", config, 4, timing);
  Bus bus;
  for (Node *node : std::initializer_list<Node *>{&host, a.get(), b.get()}) bus.add(*node);
  host.start();
  a->start();
  b->start();
  for (auto _ : state) {
    for (int i = 0; i < state.range(0); ++i)
      host.request({.id = i % 2 == 0 ? 0x190U : 0x210U, .remote = true, .dlc = 8});
    bus.run_for(10 * kMillisecond);
  }
  state.counters["node_cycles/s"] = benchmark::Counter(
      static_cast<double>(a->cycles() + b->cycles()), benchmark::Counter::kIsRate);
}
BENCHMARK(remote_nodes)->ArgName("reads")->Arg(0)->Arg(20)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace vericansim
