// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// WireJudge: holds the nodes of a bus against each other and against what the passive decoder saw
// on the wire: nothing lost, doubled or changed beyond what VA-03 allows (TH-08).
#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "judge/disturbances.hpp"
#include "judge/node_bit.hpp"
#include "model/bus_monitor.hpp"
#include "model/frame.hpp"

namespace vericansim {

/// What a WireJudge has counted.
struct WireCounts {
  std::uint64_t exchanges = 0;   ///< frames with a sender's success
  std::uint64_t deliveries = 0;  ///< at all nodes
  std::uint64_t strict = 0;      ///< exchanges in which every node was held to the frame
  std::uint64_t duplicates = 0;  ///< deliveries of an attempt that its sender repeats (VA-03)
  std::uint64_t decoded = 0;     ///< exchanges that the decoder saw in the same way
};

/// The judge. Demands are strict while nothing has disturbed the bus for kSettled bits: then a
/// frame that one node counts as sent is delivered once by every other node on the bus that has not
/// sent the same frame with it (AR-10), and stands on the wire; a delivery without a success is
/// none. In disturbed times two nodes that are not disturbed themselves agree on the content, and a
/// delivery without a success needs a sender that failed at EOF7, or a disturbance; or one that
/// failed at EOF6 after the receiver had sampled it: a node that does not hear the others starts
/// where it likes, between two sample points too.
class WireJudge {
 public:
  using Report = std::function<void(const std::string &)>;
  /// Bits after a disturbance until every node is in step again: an error passive receiver may
  /// destroy a frame or two by itself (EF-12).
  static constexpr Time kSettled = 400;

  WireJudge(Time bit_time, Report report) : bit_time_{bit_time}, report_{std::move(report)} {}

  void add_node(const std::string &name) { nodes_.push_back({name}); }
  [[nodiscard]] Disturbances &disturbances() { return disturbances_; }

  /// A bit of a node; `frame`: of the bits so far, complete if it was delivered or sent. Not to be
  /// told of a node in loop-back, which is not on the bus.
  void bit(NodeId id, Time time, const NodeBit &bit, const Frame &frame);
  /// A frame that the decoder saw.
  void on_wire(const BusFrame &frame);
  /// Judges what is still open; but what was delivered, or was on the wire, last may be ended by
  /// its sender only later.
  void finish(Time now);

  [[nodiscard]] const WireCounts &counts() const { return counts_; }

 private:
  static constexpr Time kFar = 1'000'000;
  /// Bits by which the ends of a frame differ at most, as its sender and the decoder see them.
  static constexpr Time kApart = 2;

  struct Success {
    NodeId node = 0;
    Time sof = -kSecond, end = -kSecond;
    Frame frame;
  };
  struct NodeView {
    std::string name;
    Time sof = -kSecond;       // of the frame under way or the last one
    Time failed = -kSecond;    // last attempt that failed
    bool failed_eof6 = false;  // the last attempt failed at EOF6
    bool failed_late = false;  // the last attempt failed at EOF7
    bool unheard = false;      // the last attempt failed for want of an acknowledge, error passive
    Success success{};         // last attempt that ended well
  };
  struct Delivery {
    NodeId node;
    Time sof, time;
    Frame frame;
  };

  void settle(Time nodes_until, Time wire_until);
  void judge(const Success &success);
  void judge_receiver(const Success &success, NodeId id, bool clean);
  [[nodiscard]] bool same_exchange(const Success &a, const Success &b) const;
  [[nodiscard]] bool sent_together(const Success &success) const;
  void judge_left_over(const Delivery &delivery);
  void judge_unclaimed(Time until);
  [[nodiscard]] bool clean(Time sof, Time end) const;
  [[nodiscard]] bool disturbed(NodeId id, Time sof, Time end) const;
  [[nodiscard]] std::string when(Time time) const;

  Time bit_time_;
  Report report_;
  Disturbances disturbances_;
  std::vector<NodeView> nodes_;
  std::deque<Success> successes_;  // their bit is over, the nodes' views are not complete
  std::deque<Delivery> deliveries_;
  std::deque<Success> unseen_;                   // by the decoder
  std::deque<BusFrame> unclaimed_;               // seen by the decoder, and nobody has sent them
  Time end_ = std::numeric_limits<Time>::max();  // of the run
  WireCounts counts_;
};

/// One line for a person, as in "123 [2] CA FE".
[[nodiscard]] std::string frame_text(const Frame &frame);

}  // namespace vericansim
