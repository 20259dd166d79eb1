// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BoardBus: see board_bus.hpp.
#include "boards/board_bus.hpp"

#include "trace/candump.hpp"

namespace vericansim {

ClockConfig BoardBus::clock() {
  ClockConfig config;
  config.frequency_hz = 12e6;
  return config;
}

BoardBus::BoardBus(Node &device)
    : host_{"host", {.timing = timing()}, clock()}, other_{"other", {.timing = timing()}, clock()} {
  bus_.add(host_);
  bus_.add(other_);
  bus_.add(device);
  host_.start();
  other_.start();
  run_bits(500);  // the device clears its RAM
}

std::vector<std::string> BoardBus::send(const Frame &frame, bool from_other) {
  host_.received().clear();
  (from_other ? other_ : host_).request(frame);
  run_bits(2);
  std::vector<std::string> said = settle();
  if (from_other && !said.empty()) said.erase(said.begin());  // the frame itself
  return said;
}

std::vector<std::string> BoardBus::settle() {
  constexpr unsigned kIdle = 30;
  for (unsigned idle = 0, bits = 0; idle < kIdle && bits < 10'000; ++bits) {
    run_bits(1);
    idle = host_.pending() || other_.pending() || !host_.idle() ? 0 : idle + 1;
  }
  std::vector<std::string> said;
  for (const Frame &frame : host_.received()) said.push_back(candump_frame(frame));
  host_.received().clear();
  return said;
}

}  // namespace vericansim
