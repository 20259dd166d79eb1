// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteWatch: holds what the remote nodes of a bus do against what was on the bus.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "bus/bus.hpp"
#include "bus/observer.hpp"
#include "model/bus_monitor.hpp"
#include "node/bit_timing.hpp"
#include "node/remote_unit.hpp"
#include "results/remote_report.hpp"
#include "simulation/cycle_meter.hpp"

namespace vericansim {

/// What is watched of one node.
struct WatchedUnit {
  NodeId node = 0;
  RemoteUnit *unit = nullptr;
  RemoteConfig config;
  unsigned number = 0;
  bool rtl = false;
};

/// The largest distance of the actions of two receivers `a` and `b` of one frame of `sender`
/// (RN-47). `ppm`: the largest error of a clock on the bus.
[[nodiscard]] Time skew_bound(Bus &bus, NodeId sender, NodeId a, NodeId b,
                              const std::vector<BitTiming> &timings, double ppm);

/// Follows the stage of each node by the writes on the bus (direct, and by the port WRITE), and
/// compares at each TRIGGER. A node counts from the OPERATE that the host has sent it until SAFE or
/// RESTART: if it does not act then, its set point is lost. An observer of the bus; must outlive
/// its actions.
class RemoteWatch : public BusObserver {
 public:
  /// `timings` of all nodes of the bus; `ppm` as skew_bound() takes it.
  RemoteWatch(Bus &bus, const std::vector<WatchedUnit> &units, std::vector<BitTiming> timings,
              double ppm);
  RemoteWatch(const RemoteWatch &) = delete;
  RemoteWatch &operator=(const RemoteWatch &) = delete;

  [[nodiscard]] unsigned interests() const override { return kBits; }
  /// Looks whether the node has left OPERATE.
  void on_bit(NodeId node, const BitRecord &bit) override;

  /// Times of the report count from `start`.
  void begin(Time start) { start_ = start; }
  /// A host wants to send a frame.
  void commanded(const Frame &frame);
  /// A frame has ended on the bus, which has been held for `busy` up to then.
  void on_frame(const BusFrame &frame, Time busy);
  /// apply_o of unit `index`.
  void applied(std::size_t index);
  /// A plant has written a measurement, which a statement must tell before the next TRIGGER.
  void measured(std::size_t index, unsigned address, std::uint32_t word);

  /// What a TRIGGER has done, once that is known: how many nodes have acted, and how far apart.
  std::function<void(const BusFrame &trigger, std::size_t nodes, Time skew)> on_cycle;

  /// What was seen up to now.
  [[nodiscard]] RemoteReport report();

 private:
  static constexpr unsigned kStageBytes = 16;

  struct Unit {
    WatchedUnit watched;
    RemoteNodeReport report;
    std::array<int, kStageBytes> staged{};  // -1: not written by the bus
    bool expected = false;                  // to act upon TRIGGER
    bool operates = false;
    std::array<std::uint8_t, 2> counts{};   // accepted, refused as last seen
    std::optional<std::uint32_t> measured;  // waits for its statement
    unsigned measured_at = 0;
    Time acted = 0;  // last
  };
  struct Action {
    std::size_t unit;
    Time time;
  };

  [[nodiscard]] bool is_trigger(const Frame &frame) const;
  void take_request(const Frame &frame, unsigned name, unsigned a);
  void take_state(const Frame &frame);
  void take_write(Unit &unit, const Frame &frame, unsigned a);
  void take_statement(const BusFrame &frame, unsigned name, unsigned a);
  void take_trigger(const BusFrame &frame);
  void compare_stage(std::size_t index, const std::array<int, kStageBytes> &wanted);
  void end_cycle(Time until);
  void tell_cycle(const std::vector<Action> &actions) const;
  void compare_actions(const std::vector<Action> &actions);
  void look(Unit &unit);

  Bus &bus_;
  std::vector<Unit> units_;
  std::vector<std::size_t> unit_of_;  // by node; beyond the units: none
  std::vector<BitTiming> timings_;
  double ppm_;
  Time start_ = 0;
  std::vector<Action> actions_;
  std::optional<BusFrame> trigger_;     // whose actions are being collected
  std::vector<std::uint8_t> expected_;  // by unit, when it came
  std::optional<Time> last_action_;
  RemoteReport report_;
  Time skew_sum_ = 0;
  CycleMeter meter_;
};

}  // namespace vericansim
