// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a scenario says of its remote nodes: the commands of their host, their user logic, and what
// must be true of them at the end (RN-96).
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bus/node.hpp"
#include "model/frame.hpp"
#include "scenario/number_range.hpp"

namespace vericansim {

/// One command of a host, as a frame.
struct RemoteStep {
  std::string text;  ///< as the file has it
  Frame frame;
  std::vector<unsigned> rounds;  ///< places of two data bytes each that hold the round's number
  bool counts = false;           ///< TRIGGER without a count: one more than the one before
  /// What ends the wait of a read: identifier, length, and the first `head` bytes.
  std::optional<Frame> answer;
  unsigned head = 0;
  std::optional<std::vector<std::uint8_t>> wanted;  ///< the other bytes; else the run fails
};

/// Commands of a host, one after the other.
struct RemoteCommandSpec {
  NodeId node = 0;
  Time at = 0;      ///< or as soon as the node's earlier ones are done
  Time period = 0;  ///< 0: once
  std::uint64_t count = std::numeric_limits<std::uint64_t>::max();  ///< rounds at most
  std::vector<RemoteStep> steps;
};

/// A first-order plant: at each step the current goes a quarter of the way to the set point, the
/// voltage falls by an eighth of the current from 40000.
struct PlantSpec {
  unsigned set_point = 0;  ///< address of 16 bits
  unsigned measured = 0;   ///< address of current and voltage, 16 bits each; a whole word
};

/// Something that a remote node's user logic does.
struct UserSpec {
  NodeId node = 0;
  bool after_apply = false;  ///< each time staged bytes become visible; else at times
  Time at = 0;               ///< or after the pulse
  Time period = 0;           ///< 0: once
  std::uint64_t count = std::numeric_limits<std::uint64_t>::max();
  std::map<unsigned, std::vector<std::uint8_t>> write;
  std::optional<unsigned> ramp;  ///< address of 16 bits
  unsigned from = 0, step = 1;   ///< of the ramp
  std::optional<PlantSpec> plant;
  std::optional<unsigned> event;  ///< of a producer entry, when the bytes are in the memory
};

/// What must be true at the end.
struct RemoteExpectations {
  struct Bytes {
    NodeId node = 0;
    unsigned address = 0;
    std::vector<std::uint8_t> bytes;
  };
  std::vector<Bytes> memory;
  std::map<std::string, Range> numbers;  ///< refused, triggers, lost_set_points, late_statements
  std::optional<Time> trigger_skew;      ///< largest allowed
  bool skew_within_bound = false;        ///< in each cycle (RN-47)
  std::map<NodeId, std::string> states;  ///< SAFE, OPERATE, ...
};

}  // namespace vericansim
