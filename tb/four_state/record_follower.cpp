// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// record_follower: writes the pins of a clock without a processor down, clock by clock, for
// replay_follower.sv.
//   record_follower RECORDING SIZE FILE    (SIZE: 0, there is but one)
#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>
#include <string>

#include "Vcan_time_node_pins.h"
#include "four_state/record_main.hpp"
#include "time/follower_bus.hpp"

namespace vericansim {
namespace {

constexpr double kPeriod = 250'000, kInterval = 2.5e9;  // ps: 4 MHz, and 2.5 ms between pairs

std::FILE *recording = nullptr;  // FollowerBus makes its models itself

/// Each clock edge adds a row. All outputs come from flip-flops: those before an edge are what was
/// behind the one before.
class RecordedFollower : public Vcan_time_node_pins {
 public:
  using Vcan_time_node_pins::Vcan_time_node_pins;

  /// Called by FollowerBus behind every edge of the clock.
  void after_edge() {
    if (!begun_) {
      for (int n = 0; n < 3; ++n) write(0, 1);
      begun_ = true;
    }
    write(1, can_rx_i);
    outputs_ = outputs();
  }

 private:
  [[nodiscard]] std::string outputs() const {
    return fmt::format("{:x}{:x}{:08x}{:x}", int{pps_o}, int{state_o}, offset_o, int{can_tx_o});
  }
  // As one hexadecimal word for $readmemh; the layout is that of replay_follower.sv.
  void write(int rst_n, int rx) {
    if (std::fprintf(recording, "%x%x_%s\n", rst_n, rx, outputs_.c_str()) < 0)
      throw std::runtime_error("cannot write the recording");
  }

  bool begun_ = false;
  std::string outputs_ = "00000000001";  // in reset
};

// From the first pair to LOCKED, and silence until holdover.
void pairs() {
  FollowerBus<RecordedFollower> bus{8 * kPeriod, 1'700'000'000'999'000'000};
  bus.add(kPeriod * (1 - 60e-6), 12'345);
  for (unsigned n = 0; n < 15; ++n) {
    bus.pair();
    bus.run((n + 1) * kInterval);
  }
  if (bus.node(0).state() != 2) throw std::runtime_error("recording: not locked");
  if (bus.node(0).pulses().size() < 30) throw std::runtime_error("recording: no pulses");
  bus.run(bus.now() + 12 * kInterval);
  if (bus.node(0).state() != 3) throw std::runtime_error("recording: no holdover");
}

}  // namespace
}  // namespace vericansim

int main(int argc, char **argv) {
  using namespace vericansim;
  return record_main(argc, argv, {0}, {{"pairs", [](unsigned, std::FILE *file) {
                                          recording = file;
                                          pairs();
                                        }}});
}
