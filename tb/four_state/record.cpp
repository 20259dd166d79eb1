// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// record: writes the pins of a whole core down, clock by clock, for replay.sv.
//   record --list | record RECORDING NUM_MB FILE
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

#include "Vcan_ahb16.h"
#include "Vcan_ahb16___024root.h"
#include "Vcan_ahb64.h"
#include "Vcan_ahb64___024root.h"
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

int usage() {
  std::fprintf(stderr, "usage: record --list | record RECORDING 16|64 FILE\n");
  return 2;
}

int run(int argc, char **argv) {
  if (argc == 2 && std::strcmp(argv[1], "--list") == 0) {
    for (const Recording &recording : recordings()) std::printf("%s\n", recording.name);
    return 0;
  }
  if (argc != 4) return usage();
  const std::string size = argv[2];
  for (const Recording &recording : recordings()) {
    if (recording.name != std::string{argv[1]} || (size != "16" && size != "64")) continue;
    std::FILE *file = std::fopen(argv[3], "w");
    if (file == nullptr) {
      std::perror(argv[3]);
      return 1;
    }
    record(recording, size == "16" ? 16 : 64, file);
    if (std::fclose(file) != 0) {
      std::perror(argv[3]);
      return 1;
    }
    return 0;
  }
  return usage();
}

}  // namespace
}  // namespace vericansim

int main(int argc, char **argv) {
  try {
    return vericansim::run(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "record: %s\n", error.what());
    return 1;
  }
}
