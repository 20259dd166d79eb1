// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusJudge: all judges on a bus of whole cores: for each node the rules, its buffers and the
// assertions, and for the bus as a whole what is on the wire and who has received it.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/observer.hpp"
#include "judge/node_judge.hpp"
#include "judge/wire_judge.hpp"

namespace vericansim {

/// What the judges have looked at.
struct JudgeCounts {
  std::uint64_t node_bits = 0;  ///< compared with the rules
  std::uint64_t accesses = 0;   ///< of the CPUs, told to the buffers' models
  std::uint64_t errors = 0;     ///< error events at all nodes
  std::uint64_t bus_offs = 0;
  std::uint64_t stops = 0;     ///< nodes stopped by their software
  std::uint64_t software = 0;  ///< frames that software got, compared with what its node received
  WireCounts wire;
};

/// The observer. Add it to the bus after all nodes, and the nodes to it before their first access.
class BusJudge : public BusObserver {
 public:
  explicit BusJudge(Time bit_time);
  ~BusJudge() override;

  /// The next node of the bus. `triple_sampling` and the like need no word: the judge sees samples.
  void add(RtlNode &node);
  [[nodiscard]] Disturbances &disturbances() { return wire_.disturbances(); }
  /// From `time` on every node is on the bus: without any disturbance no error may happen.
  void all_on_bus(Time time) { quiet_from_ = time; }
  /// A frame as the decoder saw it.
  void on_wire(const BusFrame &frame);
  /// The software of a node has got a frame out of its buffers; it must be the next one that its
  /// node received and `accepted` took.
  void software_received(NodeId id, const Frame &frame, bool overrun);
  /// Demands the above of a node: `accepts` says which frames its software wants.
  void expect_software(NodeId id, std::function<bool(const Frame &)> accepts);
  void finish(Time now);

  [[nodiscard]] unsigned interests() const override { return kBits | kNodeLevels; }
  void on_bit(NodeId id, const BitRecord &record) override;
  void on_node_tx(NodeId id, Time time, Level level) override;

  /// Differences in the order in which they were seen. After the bit with the first one nothing is
  /// judged any more: what follows from a difference is none.
  [[nodiscard]] const std::vector<std::string> &findings() const { return findings_; }
  /// The first difference is none of a core's: the software of a node leaves more open than the
  /// judge of its buffers can follow.
  [[nodiscard]] bool too_open() const { return too_open_; }
  [[nodiscard]] JudgeCounts counts() const;

 private:
  struct Side {
    std::string name;
    std::unique_ptr<BufferJudge> buffers;
    std::unique_ptr<NodeJudge> rules;
    Time pin_time = -1;  // last edge at the pin
    Level pin = Level::kRecessive;
    Time bit = 0;  // time of the bit that is judged
    bool bus_off = false;
    std::function<bool(const Frame &)> accepts;
    std::deque<Frame> to_software;
  };

  void judge_errors(const Side &side, const NodeBit &bit);
  void finding(const std::string &text);

  Time bit_time_;
  Time quiet_from_ = -1;
  WireJudge wire_;
  std::vector<std::unique_ptr<Side>> sides_;
  std::vector<std::string> findings_;
  bool too_open_ = false;
  JudgeCounts counts_;
};

}  // namespace vericansim
