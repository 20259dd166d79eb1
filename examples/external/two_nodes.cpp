// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Two whole controllers, each with its own clock, on one bus: a sensor reports, a display asks.
// Prints what the bus saw, as candump would.
#include <cstdio>
#include <iostream>

#include "bus/bus.hpp"
#include "model/bus_monitor.hpp"
#include "node/host.hpp"
#include "trace/candump.hpp"

using namespace vericansim;

int main() {
  auto sensor = RtlNode::create("sensor", {.error_ppm = 100});
  auto display = RtlNode::create("display", {.frequency_hz = 16e6, .error_ppm = -100});
  Bus bus;
  bus.add(*sensor, {.cable = cable_delay(5)});
  bus.add(*display, {.cable = cable_delay(5)});

  // What really crossed the wire, from a listener that shares no code with the controllers.
  const Time bit_time = 2 * kMicrosecond;  // 500 kbit/s
  BusMonitor monitor{bus, bit_time, 0.8125};
  CandumpWriter log{std::cout};
  monitor.on_frame = [&](const BusFrame &seen) { log.write({seen.end, "can0", seen.frame}); };
  bus.add(monitor);

  // Both have 16 quanta of 125 ns a bit; their clocks are 8 and 16 MHz.
  Host on_sensor{*sensor, {.timing = {.prescaler = 1, .prop = 7, .ps1 = 5, .ps2 = 3, .sjw = 3}}};
  Host on_display{*display, {.timing = {.prescaler = 2, .prop = 7, .ps1 = 5, .ps2 = 3, .sjw = 3}}};
  on_sensor.on_received = [&](const HostFrame &request) {
    if (request.frame.remote) {
      Frame answer = request.frame;
      answer.remote = false;
      answer.data = {0x01, 0x17};
      on_sensor.send(answer);
    }
  };
  on_sensor.start_and_wait();
  on_display.start_and_wait();
  bus.run_for(20 * bit_time);  // eleven recessive bits, and a node takes part

  on_sensor.send({.id = 0x123, .dlc = 2, .data = {0xCA, 0xFE}});
  on_display.send({.id = 0x18DAF110, .extended = true, .remote = true, .dlc = 2});
  const bool answered =
      bus.run_until([&] { return on_display.received().size() == 2; }, 10 * kMillisecond);
  bus.run_for(20 * bit_time);  // so that the listener sees the end of the last frame
  monitor.advance(bus.now());
  on_sensor.check();
  on_display.check();

  std::cout << "display: " << on_display.received().size() << " received, "
            << on_display.stats().sent << " sent; bus: " << monitor.frames() << " frames, "
            << monitor.error_frames() << " error frames\n";
  return answered ? 0 : 1;
}
