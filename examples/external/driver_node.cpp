// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// An application in C with the C driver on a simulated controller; its partner on the bus sends
// frames and prints what comes back.
#include <cstdio>

#include "bus/bus.hpp"
#include "echo.h"
#include "node/host.hpp"
#include "trace/candump.hpp"

using namespace vericansim;

int main() {
  auto board = RtlNode::create("board", {.frequency_hz = 16e6});
  auto partner = RtlNode::create("partner", {.error_ppm = 50});
  Bus bus;
  bus.add(*board);
  bus.add(*partner);

  // The driver's way to the registers: each access runs the bus until it is done.
  verican_port_t port{};
  port.context = board.get();
  port.read32 = [](void *node, std::uint32_t offset) {
    return static_cast<RtlNode *>(node)->read32(offset);
  };
  port.write32 = [](void *node, std::uint32_t offset, std::uint32_t value) {
    static_cast<RtlNode *>(node)->write32(offset, value);
  };
  const verican_result_t result = echo_start(&port, 16'000'000);
  if (result != VERICAN_OK) {
    std::fprintf(stderr, "driver_node: %s\n", verican_result_name(result));
    return 1;
  }
  Host host{*partner, {.timing = {.prescaler = 1, .prop = 7, .ps1 = 5, .ps2 = 3, .sjw = 3}}};
  host.on_received = [](const HostFrame &answer) {
    std::printf("answer %s\n", candump_frame(answer.frame).c_str());
  };
  host.start_and_wait();

  for (std::uint8_t n = 0; n < 3; ++n) host.send({.id = 0x200, .dlc = 2, .data = {0xEC, n}});
  unsigned answers = 0;
  const Time end = bus.now() + 10 * kMillisecond;
  while (bus.now() < end && host.stats().received < 3) {
    bus.step();
    if (board->irq()) echo_interrupt();
    answers += echo_work();
  }
  host.check();
  std::printf("driver: %u answers; partner: %llu sent, %llu received\n", answers,
              static_cast<unsigned long long>(host.stats().sent),
              static_cast<unsigned long long>(host.stats().received));
  return host.stats().received == 3 ? 0 : 1;
}
