// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Speed of the two SystemC modes beside the C++ simulator: two whole cores at 8 MHz with the C
// driver, a bus that is never idle at 500 kbit/s; the median of five runs, each in its own process.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "systemc/both_worlds.hpp"
#include "systemc/systemc_rig.hpp"

namespace vericansim {
namespace {

constexpr Time kSimulated = 400 * kMillisecond;
constexpr double kHz = 8e6;

Story story(bool same_clock) {
  Story story;
  for (unsigned i = 0; i < 2; ++i) {
    ScenarioNode node;
    node.clock = {.error_ppm = same_clock ? 0.0 : 50.0 * i, .phase = same_clock ? 1000 : 1000 + i};
    if (!same_clock) node.link = {.cable = cable_delay(10), .transmitter = 50'000};
    node.program = {.frames = 1'000'000, .number = i, .seed = i + 1, .odd_accesses = false};
    story.nodes.push_back(node);
  }
  story.end = kSimulated;
  return story;
}

// Node-cycles a second.
double measure(const std::function<void()> &run) {
  std::vector<double> speeds;
  for (int i = 0; i < 5; ++i) {
    const std::string text = simulate_for([&run] {
      timespec begin{}, end{};
      clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
      run();
      clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
      return std::to_string(static_cast<double>(end.tv_sec - begin.tv_sec) +
                            1e-9 * static_cast<double>(end.tv_nsec - begin.tv_nsec));
    });
    speeds.push_back(2.0 * kHz * 1e-12 * static_cast<double>(kSimulated) / std::stod(text));
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds[speeds.size() / 2];
}

void show(const std::string &name, const std::function<void(const Story &)> &run) {
  std::printf("%-44s", name.c_str());
  for (const bool same : {true, false}) {
    const Story both = story(same);
    std::printf(" %8.2f", measure([&] { run(both); }) / 1e6);
    std::fflush(stdout);
  }
  std::printf("\n");
}

}  // namespace
}  // namespace vericansim

int main() {
  using namespace vericansim;
  std::printf("%-44s %8s %8s\n", "million node-cycles a second (CPU time)", "in step", "drifting");
  show("C++ simulator", [](const Story &both) { run_in_simulator(both); });
  show("cycle-exact, own oscillators", [](const Story &both) { run_in_systemc(both, {}); });
  show("cycle-exact, clk ports",
       [](const Story &both) { run_in_systemc(both, {.clk_ports = true}); });
  for (const Time quantum : {1, 10, 100}) {
    show("loosely timed, quantum " + std::to_string(quantum) + " us", [quantum](const Story &both) {
      run_in_systemc(both, {.timing = TlmTiming::kLooselyTimed, .quantum = quantum * kMicrosecond});
    });
  }
  return 0;
}
