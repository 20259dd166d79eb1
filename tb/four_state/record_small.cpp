// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// record_small: as record.cpp, of the profile that lacks every feature. Nothing clears its RAM
// (ClearRam = 0): software writes all of it first.
//   record_small RECORDING SIZE FILE    (SIZE: 0, there is but one)
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "Vcan_ahb_small.h"
#include "Vcan_ahb_small___024root.h"
#include "four_state/record_main.hpp"
#include "four_state/record_node.hpp"
#include "four_state/scenarios.hpp"

namespace vericansim {
namespace {

void clear_ram(MailboxRig &rig) {
  rig.configure(0);
  for (std::uint32_t mask : {reg::kRxgmask, reg::kRx14mask, reg::kRx15mask}) rig.write(0, mask, 0);
  for (unsigned mb = 0; mb < rig.num_mb(); ++mb) rig.put(0, mb, {});
}

void record(const Recording &recording, std::FILE *file) {
  const CoreBuild &build = core_build("small");
  std::vector<std::unique_ptr<RtlNode>> nodes;
  nodes.push_back(std::make_unique<RecordNode<Vcan_ahb_small>>("recorded", build.num_mb, file));
  nodes.push_back(RtlNode::create("peer", {}, build.num_mb));
  MailboxRig rig{std::move(nodes)};
  clear_ram(rig);
  recording.run(rig);
}

}  // namespace
}  // namespace vericansim

int main(int argc, char **argv) {
  using namespace vericansim;
  std::vector<RecordTask> tasks;
  for (const Recording &recording : recordings()) {
    // The others read what nobody has written, or need what is not there.
    const std::string name = recording.name;
    if (name != "frames" && name != "arbitration" && name != "errors" && name != "bus_off")
      continue;
    tasks.push_back(
        {recording.name, [&recording](unsigned, std::FILE *file) { record(recording, file); }});
  }
  return record_main(argc, argv, {0}, tasks);
}
