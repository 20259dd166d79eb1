// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Producers and maps of all nodes of a bus, and what is wrong with them (RN-95).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/cli.hpp"
#include "scenario/remote_tables.hpp"

namespace vericansim::cli {

/// An entry of the producers' table (RN-63).
struct ProducerEntry {
  unsigned a = 0, mode = 0, period = 0, gap = 0;
  [[nodiscard]] unsigned length() const { return mode & 0x0F; }
};

/// The tables of one node.
struct NodeTables {
  unsigned number = 0;
  bool heard_own = false;  ///< from another node, since the last CLEAR (DUP, RN-11)
  RemoteConfig config;     ///< as far as the node tells it
  std::vector<ProducerEntry> producers;
  std::vector<RemoteMapEntry> maps;
};

/// The tables from F40 to FBF as they are read; entries that are off are left out.
[[nodiscard]] NodeTables read_tables(unsigned number, const std::vector<std::uint8_t> &bytes);

/// What is wrong: nodes that have heard their own number, entries of a map that write the same
/// bytes, entries that can never have an effect or wait for identifiers that nobody sends.
[[nodiscard]] std::vector<std::string> complaints(const std::vector<NodeTables> &nodes,
                                                  unsigned name_bits);

/// The tables in words, a line for each entry.
[[nodiscard]] std::string to_text(const std::vector<NodeTables> &nodes, unsigned name_bits);
[[nodiscard]] Json to_json(const std::vector<NodeTables> &nodes);

}  // namespace vericansim::cli
