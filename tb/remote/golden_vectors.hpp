// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The golden vectors of can_remote as they stand in sw/remote/vectors.yaml, whose head explains
// each key.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "model/frame.hpp"

namespace vericansim::golden {

/// One frame to the node, and what it sends in return.
struct Step {
  Frame send;
  bool from_node = false;                             ///< sent by another node, not by the host
  std::map<std::string, std::vector<Frame>> answers;  ///< by profile, or alone under ""
  std::map<unsigned, Frame> others;                   ///< by number: what other nodes send besides

  /// The answers of a node of `profile`: small, standard or full.
  [[nodiscard]] const std::vector<Frame> &answers_of(const std::string &profile) const;
};

/// What a client is asked; members that a call does not have are 0 or empty.
struct Call {
  std::string what;  ///< as in the file's head; "frame": `frame` as it is
  Frame frame;
  unsigned node = 0;
  unsigned address = 0;
  unsigned length = 0;
  unsigned count = 0;
  unsigned tag = 0;
  std::uint32_t value = 0;
  std::uint32_t mask = 0;
  std::string command;  ///< of state
  std::vector<std::uint8_t> data;
  bool here = false;                                       ///< what select gives
  std::map<std::string, std::vector<std::uint8_t>> gives;  ///< by profile, or alone under ""
  std::map<unsigned, std::vector<std::uint8_t>> nodes;     ///< what poll gives, by number

  /// What it gives with a node of `profile`; empty: nothing.
  [[nodiscard]] std::vector<std::uint8_t> gives_with(const std::string &profile) const;
};

/// A group of steps with what holds when the last has been carried out.
struct Vector {
  unsigned number = 0;
  std::string what;
  std::set<std::string> needs;  ///< features, as features_of() names them
  std::vector<Step> steps;
  std::vector<Call> calls;  ///< in place of the steps, for clients; none: nobody calls that
  std::map<std::uint16_t, std::vector<std::uint8_t>> memory;         ///< address, bytes from there
  std::optional<std::array<std::optional<std::uint8_t>, 8>> status;  ///< row of STATUS; none: any
  std::optional<unsigned> node;                                      ///< the node's number
};

/// A node from its reset to its end.
struct Life {
  unsigned name_bits = 0;
  unsigned number = 0;
  std::uint32_t serial = 0;
  Frame boot;  ///< sent by the node itself after the start
  std::vector<Vector> vectors;

  /// The vectors that a node with `features` can run, in their order.
  [[nodiscard]] std::vector<Vector> for_features(const std::set<std::string> &features) const;
};

/// Features of a profile: small, standard or full. Throws std::out_of_range for any other name.
const std::set<std::string> &features_of(const std::string &profile);

/// Reads a file of vectors. Throws InputError (file, line, what is allowed).
std::vector<Life> load(const std::string &path = "sw/remote/vectors.yaml");

/// "21 write a block", for GoogleTest.
void PrintTo(const Vector &vector, std::ostream *out);

}  // namespace vericansim::golden
