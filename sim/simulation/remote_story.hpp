// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteStory: what happened on a bus of remote nodes, frame by frame (RN-97).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "bus/bus.hpp"
#include "bus/observer.hpp"
#include "model/bus_monitor.hpp"
#include "report/report_data.hpp"
#include "results/remote_report.hpp"
#include "simulation/remote_watch.hpp"

namespace vericansim {

/// Writes down each frame in words, and for a page the states and the windows of the nodes. An
/// observer of the bus; must outlive its actions.
class RemoteStory : public BusObserver {
 public:
  /// Frames that a report in text or JSON tells.
  static constexpr std::size_t kTold = 1000;

  /// Without `page` only the first frames are kept.
  RemoteStory(Bus &bus, const std::vector<WatchedUnit> &units, bool page);
  RemoteStory(const RemoteStory &) = delete;
  RemoteStory &operator=(const RemoteStory &) = delete;

  [[nodiscard]] unsigned interests() const override { return page_ ? kBits : 0U; }
  void on_bit(NodeId node, const BitRecord &bit) override;

  /// The scenario starts now: everything before is forgotten.
  void begin();
  [[nodiscard]] bool for_page() const { return page_; }
  /// The memory of unit `index` changes now.
  void written(std::size_t index);
  /// A frame has ended on the bus.
  void on_frame(const BusFrame &frame);
  /// What a TRIGGER has done, once that is known: `nodes` have acted, first to last within `skew`.
  void on_cycle(const BusFrame &trigger, std::size_t nodes, Time skew);
  /// Looks at the nodes for the last time.
  void finish();

  /// For the page.
  [[nodiscard]] const RemoteColumns &columns() const { return columns_; }
  /// Adds the first frames to a report.
  void describe(RemoteReport &report) const;

 private:
  struct Unit {
    WatchedUnit watched;
    int state = -1;
    std::vector<std::uint8_t> window;
  };

  [[nodiscard]] double ns(Time time) const { return static_cast<double>(time - start_) / 1e3; }
  [[nodiscard]] std::uint32_t index_of(const std::string &words);
  void look_at_state(Unit &unit, Time time);
  void look_at_window(Unit &unit, Time time);

  Bus &bus_;
  std::vector<Unit> units_;
  bool page_;
  Time start_ = 0;
  std::vector<Time> starts_;  // of the frames
  std::vector<RemoteFrameReport> told_;
  std::uint64_t frames_ = 0;
  std::unordered_map<std::string, std::uint32_t> known_;  // words, by their text
  RemoteColumns columns_;
};

}  // namespace vericansim
