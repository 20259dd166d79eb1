// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Loosely timed against cycle-exact: the same frames and the same registers, and times that differ
// by the quantum at most.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "systemc/both_worlds.hpp"
#include "systemc/can_bus.hpp"
#include "systemc/register_software.hpp"
#include "systemc/socket_bench.hpp"
#include "systemc/systemc_rig.hpp"

namespace vericansim {
namespace {

class Quantum : public ::testing::TestWithParam<Time> {};

INSTANTIATE_TEST_SUITE_P(Microseconds, Quantum,
                         ::testing::Values(0, 3 * kMicrosecond, 25 * kMicrosecond,
                                           100 * kMicrosecond),
                         [](const auto &param) {
                           return "Q" + std::to_string(param.param / kMicrosecond);
                         });

// ---- Frames at fixed times

// What a run of the two nodes below leaves: when each frame began on the wire, and all registers.
struct Result {
  std::vector<Time> starts;
  std::vector<std::uint32_t> registers;
};

constexpr unsigned kFrames = 20;
constexpr Time kPeriod = 500 * kMicrosecond;  // a frame takes 0.13 ms
constexpr Time kBit = 2 * kMicrosecond;
const char *const kNames[] = {"a", "b"};

// The local time of a program comes to `time`; with a quantum, without giving way before its end.
void go_to(Master &cpu, Time time, Time quantum) {
  if (cpu.local() < to_sc_time(time)) cpu.ahead += to_sc_time(time) - cpu.local();
  if (cpu.ahead >= to_sc_time(quantum)) cpu.sync();
}

// Takes frame `n` out of buffer 0 in the middle of its period.
void receive(Master &cpu, unsigned n, Time quantum) {
  go_to(cpu, (n + 2) * kPeriod + kPeriod / 2, quantum);
  EXPECT_EQ(cpu.read32(reg::kIflag1), 0x1u) << "frame " << n;
  cpu.read32(reg::mb(0));
  EXPECT_EQ(cpu.read32(reg::mb(0, 1)), (0x100 + n) << 18);
  cpu.read32(reg::kTimer);
  cpu.write32(reg::kIflag1, 0x1);
}

// Sends every other frame and receives those between; polls, so that its time runs ahead.
void talk(Master &cpu, unsigned number, Time quantum) {
  join(cpu);
  for (unsigned n = 0; n < kFrames; ++n) {
    if (n % 2 != number) {
      receive(cpu, n, quantum);
      continue;
    }
    go_to(cpu, (n + 2) * kPeriod, quantum);
    send_plain(cpu, 0x100 + n, static_cast<std::uint16_t>(0x1111 * n));
    while (cpu.read32(reg::kIflag1) != 0x100)
      go_to(cpu, to_ps(cpu.local()) + 5 * kMicrosecond, quantum);
    cpu.write32(reg::kIflag1, 0x100);
  }
}

Result run_at_fixed_times(TlmTiming timing, Time quantum) {
  std::ostringstream text;
  CanBus bus("bus");
  bus.set_quantum(to_sc_time(quantum));
  std::vector<std::unique_ptr<VericanTlm>> cans;
  std::vector<std::unique_ptr<Master>> cpus;
  for (unsigned i = 0; i < 2; ++i) {
    cans.push_back(std::make_unique<VericanTlm>(
        kNames[i], TlmConfig{.timing = timing, .clock = {.error_ppm = 40.0 * i, .phase = 900}}));
    bus.attach(*cans[i], {.cable = 20'000, .transmitter = 40'000, .receiver = 60'000});
    const bool loose = timing == TlmTiming::kLooselyTimed;
    cpus.push_back(std::make_unique<Master>(
        (std::string{kNames[i]} + "_cpu").c_str(),
        [i, loose, quantum](Master &cpu) { talk(cpu, i, loose ? quantum : 0); },
        to_sc_time(loose ? quantum : 0)));
    cpus[i]->socket.bind(cans[i]->socket);
  }
  // When the frames begin, from the transmitters' own pins: both modes have the core's trace.
  Result result;
  struct Watcher : BusObserver {
    explicit Watcher(Result &r) : result{r} {}
    [[nodiscard]] unsigned interests() const override { return kLevels; }
    void on_level(Time time, Level level) override {
      if (level == Level::kDominant && time > quiet_since + 11 * kBit)
        result.starts.push_back(time);
      quiet_since = level == Level::kRecessive ? time : time + kSecond;
    }
    Result &result;
    Time quiet_since = 0;
  } watcher(result);
  if (timing == TlmTiming::kLooselyTimed) bus.kernel().add(watcher);
  if (timing == TlmTiming::kCycleExact) {
    sc_core::sc_spawn_options options;
    options.spawn_method();
    options.dont_initialize();
    options.set_sensitivity(&bus.level.value_changed_event());
    sc_core::sc_spawn(
        [&] { watcher.on_level(to_ps(sc_core::sc_time_stamp()), to_level(bus.level.read())); },
        "watcher", &options);
  }
  sc_core::sc_start(to_sc_time((kFrames + 4) * kPeriod));
  for (unsigned i = 0; i < 2; ++i) {
    EXPECT_TRUE(cpus[i]->finished);
    EXPECT_TRUE(cans[i]->node().ahb().checker().violations().empty());
    for (std::uint32_t address = 0; address < kSocketWindow; address += 4) {
      std::uint32_t word = cpus[i]->peek32(address);
      const bool buffer = address >= reg::mb(0) && address < reg::mb(64);
      if (buffer && address % 16 == 0) word &= 0xFFFF0000u;  // time stamps
      if (address != reg::kTimer) result.registers.push_back(word);
    }
  }
  return result;
}

std::string to_text(const Result &result) {
  std::ostringstream text;
  text << result.starts.size();
  for (const Time time : result.starts) text << ' ' << time;
  text << ' ' << result.registers.size();
  for (const std::uint32_t word : result.registers) text << ' ' << word;
  return text.str();
}

Result from_text(const std::string &text) {
  std::istringstream in(text);
  Result result;
  std::size_t count = 0;
  in >> count;
  result.starts.resize(count);
  for (Time &time : result.starts) in >> time;
  in >> count;
  result.registers.resize(count);
  for (std::uint32_t &word : result.registers) in >> word;
  return result;
}

// A frame starts at the next bit, so a quantum and a bit is the bound; without a quantum it is the
// bit, because accesses are taken when the bus has got to them.
TEST_P(Quantum, FramesBeginWithinAQuantumOfTheExactTimeAndTheRegistersAreTheSame) {
  const Result exact = from_text(
      simulate_for([] { return to_text(run_at_fixed_times(TlmTiming::kCycleExact, 0)); }));
  const Result loose = from_text(simulate_for(
      [] { return to_text(run_at_fixed_times(TlmTiming::kLooselyTimed, GetParam())); }));
  ASSERT_EQ(exact.starts.size(), kFrames);
  ASSERT_EQ(loose.starts.size(), kFrames);
  for (unsigned i = 0; i < kFrames; ++i) {
    EXPECT_LE(std::abs(exact.starts[i] - loose.starts[i]), GetParam() + kBit) << "frame " << i;
    EXPECT_GE(exact.starts[i], (i + 2) * kPeriod) << "frame " << i;
  }
  EXPECT_EQ(exact.registers, loose.registers);
}

// Less than a clock, zero among them, is one clock; the bus is never further behind.
TEST(LooselyTimed, TheQuantumMayBeSetDuringTheSimulation) {
  simulate([] {
    Bench bench(TlmTiming::kLooselyTimed);
    bench.run([&bench](Master &cpu) {
      const std::pair<sc_time, sc_time> cases[] = {{sc_core::SC_ZERO_TIME, kClock},
                                                   {sc_time(1, sc_core::SC_PS), kClock},
                                                   {sc_time(7, sc_core::SC_US), kClock * 56}};
      for (const auto &[quantum, most] : cases) {
        bench.bus.set_quantum(quantum);
        for (unsigned i = 0; i < 20; ++i) {
          cpu.pause(sc_time(1030, sc_core::SC_NS));
          const Time lag = to_ps(sc_core::sc_time_stamp()) - bench.bus.kernel().now();
          EXPECT_LE(to_sc_time(lag), most);
        }
      }
    });
  });
}

// ---- Full load

Story busy() {
  Story story;
  for (unsigned i = 0; i < 3; ++i) {
    ScenarioNode node;
    node.clock = {.error_ppm = 80.0 - 70.0 * i, .phase = static_cast<Time>(1000 + 31'000 * i)};
    node.link = {.cable = cable_delay(5.0 * i), .transmitter = 40'000, .receiver = 60'000};
    node.program = {.frames = 60, .number = i, .seed = 21 + i};
    story.nodes.push_back(node);
  }
  story.spoiler_clock = {.phase = 5'555};
  // None hits the last bit of a frame: that would rightly come twice (VA-01, VA-02).
  for (std::uint64_t cycle = 51'000; cycle < 480'000; cycle += 33'333)
    story.spoils.emplace_back(cycle, 20);
  story.end = 60 * kMillisecond;
  return story;
}

using Key = std::tuple<std::uint32_t, unsigned, unsigned, std::vector<std::uint8_t>>;

std::vector<Key> sorted(const std::vector<verican_frame_t> &frames) {
  std::vector<Key> keys;
  for (const verican_frame_t &f : frames)
    keys.emplace_back(f.id, f.flags, f.dlc, std::vector<std::uint8_t>(f.data, f.data + 8));
  std::sort(keys.begin(), keys.end());
  return keys;
}

// Arbitration, errors and three drivers at once: every frame arrives everywhere, once, unchanged.
TEST_P(Quantum, AtFullLoadEveryFrameArrivesAsInTheExactRun) {
  simulate([] {
    const Story story = busy();
    const Seen exact = run_in_simulator(story);
    const Seen loose =
        run_in_systemc(story, {.timing = TlmTiming::kLooselyTimed, .quantum = GetParam()});
    for (unsigned i = 0; i < 3; ++i) {
      EXPECT_EQ(exact.received[i].size(), 120u);
      EXPECT_EQ(loose.stats[i].sent, 60u);
      EXPECT_GT(loose.stats[i].error_events, 0u);
      EXPECT_TRUE(sorted(loose.received[i]) == sorted(exact.received[i])) << "node " << i;
    }
  });
}

}  // namespace
}  // namespace vericansim
