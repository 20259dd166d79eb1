// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReportRecorder: collects what a report shows while a bus runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/observer.hpp"
#include "model/bus_monitor.hpp"
#include "report/bit_track.hpp"
#include "report/event_matcher.hpp"
#include "report/report_data.hpp"
#include "report/segment_builder.hpp"

namespace vericansim {

/// What a report says about the bus as a whole, and what the bus itself does not know.
struct ReportSetup {
  std::string title;
  std::string note;  ///< one line, or empty
  double bitrate = 0;
  Time bit_time = 0;               ///< nominal, ps
  std::vector<BitTiming> timings;  ///< of each node
};

/// Which message a frame belongs to, as far as its sender's software knows.
struct FrameOrigin {
  int message = -1;              ///< index of the message in the scenario, -1: none
  std::optional<Time> response;  ///< from the event that queued it to the end of the frame, ps
};

/// Memory: about 2 bytes for each bit of traffic and each edge. Add it to the bus after its nodes;
/// bus and monitor must outlive what it is asked for.
class ReportRecorder : public BusObserver {
 public:
  /// Frames whose bits and edges are kept, unless told otherwise.
  static constexpr std::uint64_t kDefaultLimit = 200'000;

  /// Puts itself before `monitor.on_event`. The setup needs a timing for each node of the bus
  /// (std::invalid_argument). Bits and edges are kept for the first `limit` frames.
  ReportRecorder(Bus &bus, BusMonitor &monitor, ReportSetup setup,
                 std::uint64_t limit = kDefaultLimit);

  [[nodiscard]] unsigned interests() const override { return kLevels | kNodeLevels | kBits; }
  void on_level(Time time, Level level) override;
  void on_node_tx(NodeId node, Time time, Level level) override;
  void on_node_rx(NodeId node, Time time, Level level) override;
  void on_bit(NodeId node, const BitRecord &bit) override;

  /// The scenario starts now: everything before is forgotten. Faults are on the bus by now.
  void begin();
  /// A frame as the monitor has it, in the order of the bus.
  void add(const BusFrame &frame, const FrameOrigin &origin = {});
  /// Completes the columns at the present time of the bus.
  void finish();

  [[nodiscard]] const ReportData &data() const { return data_; }
  [[nodiscard]] const ReportSetup &setup() const { return setup_; }
  [[nodiscard]] const Bus &bus() const { return bus_; }
  [[nodiscard]] const BusMonitor &monitor() const { return monitor_; }
  [[nodiscard]] Time started() const { return start_; }
  [[nodiscard]] Time ended() const { return end_; }
  /// Up to here there are segments and edges.
  [[nodiscard]] Time details_ended() const { return details_end_; }
  [[nodiscard]] std::uint64_t limit() const { return limit_; }
  [[nodiscard]] double wall_seconds() const;
  /// ns since the start.
  [[nodiscard]] double ns(double time) const { return (time - static_cast<double>(start_)) / 1e3; }

 private:
  struct Pin {
    Level level = Level::kRecessive, before = Level::kRecessive;
    Time changed = 0;
    void change(Time time, Level to);
    [[nodiscard]] Level at(Time time) const { return time >= changed ? level : before; }
  };
  struct NodeState {
    explicit NodeState(const BitTrack &t) : track{t} {}
    BitTrack track;
    Pin tx, rx;
    bool passive = false, off = false, after_overload = false;
    unsigned tec = 0, rec = 0;
    unsigned failed = 0, lost = 0;            // since its frame before
    unsigned done_failed = 0, done_lost = 0;  // of its last frame
  };

  void find_trouble(NodeId id, const TrackedBit &before, const TrackedBit &bit, const Trace &after);
  void count_attempts(NodeId id, const TrackedBit &bit, const Trace &after);
  void note_counters(NodeId id, const TrackedBit &bit, const Trace &after);
  void add_counters(NodeId id, double time_ns);
  void settle_losses(NodeId winner);
  void end_details(Time time);
  void reset_nodes();

  Bus &bus_;
  BusMonitor &monitor_;
  ReportSetup setup_;
  std::uint64_t limit_;
  Time start_ = 0, end_ = 0, details_end_ = 0;
  bool details_ = true, finished_ = false;
  ReportData data_;
  std::vector<NodeState> nodes_;
  std::unique_ptr<SegmentBuilder> segments_;
  std::unique_ptr<EventMatcher> events_;
  std::size_t settled_losses_ = 0;  // rows whose winner is known
  std::chrono::steady_clock::time_point wall_start_, wall_end_;
};

}  // namespace vericansim
