// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// record_remote: writes the pins of a node without a processor down, clock by clock, for
// replay_remote.sv.
//   record_remote RECORDING SIZE FILE    (SIZE: 0, there is but one)
#include <cstdio>
#include <stdexcept>
#include <string>

#include "Vcan_remote_pins.h"
#include "boards/board_bus.hpp"
#include "four_state/record_main.hpp"
#include "four_state/record_remote_node.hpp"
#include "remote/golden_vectors.hpp"
#include "remote/random_host.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

using Device = RecordRemoteNode<Vcan_remote_pins>;

struct Rig {
  explicit Rig(std::FILE *file) : device{BoardBus::clock(), file}, bus{device} {}
  std::vector<std::string> send(const std::string &text) {
    Frame frame;
    if (!parse_candump_frame(text, frame, {text, 0})) throw std::logic_error("no frame: " + text);
    return bus.send(frame);
  }
  Device device;
  BoardBus bus;
};

void need(bool done, const char *what) {
  if (!done) throw std::runtime_error(std::string{"recording: "} + what);
}

// Every command by each answer.
void vectors(Rig &rig) {
  unsigned answers = 0;
  for (const golden::Vector &vector :
       golden::load().front().for_features(golden::features_of("full")))
    for (const golden::Step &step : vector.steps)
      answers += static_cast<unsigned>(rig.bus.send(step.send, step.from_node).size());
  need(answers > 10, "golden vectors are not answered");
}

// Good and bad commands, beside accesses of user logic and holds.
void commands(Rig &rig) {
  RandomHost dice{3};
  unsigned answers = 0;
  for (unsigned i = 0; i < 120; ++i) {
    rig.device.access({dice.once_in(2), dice.upto(16), dice.upto(1024), dice.upto(~0U)});
    rig.device.hold(dice.once_in(4));
    const Frame frame = dice.frame();
    answers += static_cast<unsigned>(rig.bus.send(frame, (frame.id & 0x400) != 0).size());
  }
  need(answers > 20, "random commands are not answered");
}

// Producers by time, by TRIGGER and by event_i; the watchdog ends OPERATE; RESTART.
void producers(Rig &rig) {
  rig.device.access({true, 0xF, 0xF40 / 4, 0x0001'9440});  // 0: 4 bytes of 040, each millisecond
  rig.device.access({true, 0xF, 0xF48 / 4, 0x0001'D220});  // 1: 2 bytes of 020, each TRIGGER
  rig.device.access({true, 0xF, 0xF50 / 4, 0x0000'A130});  // 2: 1 byte of 030, on change
  rig.device.access({true, 0x4, 0xF00 / 4, 0x0003'0000});  // watchdog: 3 ms
  (void)rig.send("000#8103");
  (void)rig.send("000#01");
  need(rig.device.operates(), "not in OPERATE");
  rig.bus.run_bits(1500);
  need(!rig.send("001#01").empty(), "no statement");
  (void)rig.send("1B0#77");
  rig.device.event(2);
  rig.bus.run_bits(1200);
  need(rig.bus.settle().size() >= 3, "no statements by time, on change and by event");
  rig.bus.run_bits(5000);
  need(!rig.device.operates(), "the watchdog does not end OPERATE");
}

RecordTask task(const char *name, void (*run)(Rig &rig)) {
  return {name, [run](unsigned, std::FILE *file) {
            Rig rig{file};
            run(rig);
          }};
}

}  // namespace
}  // namespace vericansim

int main(int argc, char **argv) {
  using namespace vericansim;
  return record_main(
      argc, argv, {0},
      {task("vectors", vectors), task("commands", commands), task("producers", producers)});
}
