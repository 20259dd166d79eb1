// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// record_time: as record.cpp, of a core of 16 buffers with the time unit.
//   record_time RECORDING SIZE FILE    (SIZE: 0, there is but one)
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "Vcan_ahb16_time.h"
#include "Vcan_ahb16_time___024root.h"
#include "four_state/record_main.hpp"
#include "four_state/record_node.hpp"
#include "four_state/scenarios.hpp"
#include "verican/verican_regs.h"

namespace vericansim {
namespace {

using Recorded = RecordNode<Vcan_ahb16_time>;

void need(bool done, const char *what) {
  if (!done) throw std::runtime_error(std::string{"recording: "} + what);
}

// Every register from reset on, patterns into all that can be written, the pins.
void registers(MailboxRig &rig, Recorded &node) {
  const auto read_all = [&rig] {
    for (std::uint32_t address = 0x1100; address < 0x1200; address += 4) rig.read(0, address);
    for (std::uint32_t address = 0x1400; address < 0x1480; address += 4) rig.read(0, address);
  };
  read_all();
  rig.run(100);  // the RAM is cleared
  read_all();
  for (const std::uint32_t pattern : {0xFFFFFFFFu, 0xA5C396F0u, 0u}) {
    for (std::uint32_t address = 0x1104; address < 0x1150; address += 4)
      rig.write(0, address, pattern);
    read_all();
  }
  rig.write(0, VERICAN_TINCN_OFFSET, 125);
  rig.write(0, VERICAN_TINCF_OFFSET, 0x80000001);
  rig.write(0, VERICAN_TSLEW_OFFSET, 0xFFFFFFF0);
  rig.write(0, VERICAN_TCTRL_OFFSET, 0x001F3331);
  rig.write(0, VERICAN_TCMPH_OFFSET, 4000);
  rig.write(0, VERICAN_TCMP_OFFSET, rig.read(0, VERICAN_TIMELO_OFFSET) + 3000);
  for (unsigned i = 0; i < 6; ++i) {
    node.external(i % 2 == 0);
    rig.run(50);
  }
  need((rig.read(0, VERICAN_TSTAT_OFFSET) & 7) == 7, "no external event, or no match");
  rig.write(0, VERICAN_TSTAT_OFFSET, 0x3F);
  read_all();
}

// Frames either way with each point, one of them held; their stamps.
void stamps(MailboxRig &rig) {
  for (unsigned n : {0u, 1u}) rig.configure(n);
  rig.put_rx(0, 3, {.id = 0x155}, 0);
  for (unsigned n : {0u, 1u}) rig.go(n);
  for (const std::uint32_t point : {0x31u, 0x30u, 0x32u, 0x35u}) {
    rig.write(0, VERICAN_TCTRL_OFFSET, point);
    rig.put_tx(1, 9, {.id = 0x123, .dlc = 2, .data = {1, 2}});
    need(rig.wait_flag(0, 3), "a frame is not received");
    (void)rig.get(0, 3);
    need(rig.read(0, VERICAN_STAMPLO_OFFSET(3)) != 0, "a received frame has no stamp");
    rig.read(0, VERICAN_STAMPHI_OFFSET(3));
    rig.read(0, reg::kTimer);  // unlocks it
    rig.clear_flag(0, 3);
    rig.write(0, VERICAN_TTX_OFFSET, rig.read(0, VERICAN_TIMELO_OFFSET) + 100000);
    rig.write(0, VERICAN_TTXMB_OFFSET, VERICAN_TTXMB_HOLD_MASK | 8);
    rig.put_tx(0, 8, {.id = 0x155, .dlc = 1});
    need(rig.wait_flag(0, 8), "a held frame is not sent");
    rig.read(0, VERICAN_STAMPLO_OFFSET(8));
    rig.read(0, VERICAN_STAMPHI_OFFSET(8));
    rig.clear_flag(0, 8);
  }
}

/// One of the recordings above, or of scenarios.hpp.
void record(const std::string &name, std::FILE *file) {
  auto recorded = std::make_unique<Recorded>("recorded", 16, file);
  Recorded &node = *recorded;
  std::vector<std::unique_ptr<RtlNode>> nodes;
  nodes.push_back(std::move(recorded));
  nodes.push_back(RtlNode::create("peer", {}, 16));
  MailboxRig rig{std::move(nodes)};
  if (name == "time_registers") return registers(rig, node);
  if (name == "time_stamps") return stamps(rig);
  for (const Recording &recording : recordings())
    if (name == recording.name) recording.run(rig);
}

}  // namespace
}  // namespace vericansim

int main(int argc, char **argv) {
  using namespace vericansim;
  std::vector<RecordTask> tasks;
  for (const char *name : {"time_registers", "time_stamps", "fifo", "arbitration", "bus_off"})
    tasks.push_back({name, [name](unsigned, std::FILE *file) { record(name, file); }});
  return record_main(argc, argv, {0}, tasks);
}
