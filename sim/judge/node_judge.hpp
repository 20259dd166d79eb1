// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeJudge: the rule-based node model beside a whole core on a bus; every bit is compared (rule
// 19.5).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "judge/buffer_judge.hpp"
#include "judge/node_assertions.hpp"
#include "judge/node_bit.hpp"
#include "judge/rule_follower.hpp"

namespace vericansim {

/// Follows one node bit by bit (RuleFollower); beside that the assertions of TH-06, TH-07.
///
/// What the node has to send is known from its buffers. Where the specification leaves open which
/// of two buffers goes first, there is one model for each, and those that the node contradicts are
/// dropped. A buffer that has waited long enough must start at the first point at which the rules
/// let it (IF-03, IF-06).
class NodeJudge {
 public:
  using Report = std::function<void(const std::string &)>;

  /// `report` is told the first difference, and every broken assertion.
  NodeJudge(BufferJudge &buffers, Report report);

  /// The next bit of the node; `pin`: its TX pin at the sample point.
  void bit(const BitRecord &record, Level pin);

  /// The model, or one of those that are still possible.
  [[nodiscard]] const NodeModel &model() const { return followers_.front().model(); }
  /// The node was stopped and has begun anew in the last bit.
  [[nodiscard]] bool restarted() const { return restarted_; }
  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::uint64_t bits() const { return bits_; }

 private:
  void cut(const Trace &at);
  void interfere(const BufferJudge::Interference &what);
  void prepare(const NodeBit &bit, bool own);
  void compare(const NodeBit &bit);
  void tell_buffers(const NodeBit &bit, bool own);

  BufferJudge &buffers_;
  Report report_;
  NodeAssertions assertions_;
  std::vector<RuleFollower> followers_ = std::vector<RuleFollower>(1);
  bool in_header_ = false;
  bool restarted_ = false;
  bool failed_ = false;
  std::uint64_t bits_ = 0;
};

}  // namespace vericansim
