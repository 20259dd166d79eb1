// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// record: writes the pins of a whole core down, clock by clock, for replay.sv.
//   record RECORDING NUM_MB FILE
#include <cstdio>
#include <memory>
#include <vector>

#include "Vcan_ahb16.h"
#include "Vcan_ahb16___024root.h"
#include "Vcan_ahb64.h"
#include "Vcan_ahb64___024root.h"
#include "four_state/record_main.hpp"
#include "four_state/record_node.hpp"
#include "four_state/scenarios.hpp"

namespace vericansim {
namespace {

void record(const Recording &recording, unsigned num_mb, std::FILE *file) {
  std::vector<std::unique_ptr<RtlNode>> nodes;
  if (num_mb == 16)
    nodes.push_back(std::make_unique<RecordNode<Vcan_ahb16>>("recorded", num_mb, file));
  else
    nodes.push_back(std::make_unique<RecordNode<Vcan_ahb64>>("recorded", num_mb, file));
  nodes.push_back(RtlNode::create("peer", {}, num_mb));
  MailboxRig rig{std::move(nodes)};
  recording.run(rig);
}

}  // namespace
}  // namespace vericansim

int main(int argc, char **argv) {
  using namespace vericansim;
  std::vector<RecordTask> tasks;
  for (const Recording &recording : recordings())
    tasks.push_back({recording.name, [&recording](unsigned num_mb, std::FILE *file) {
                       record(recording, num_mb, file);
                     }});
  return record_main(argc, argv, {16, 64}, tasks);
}
