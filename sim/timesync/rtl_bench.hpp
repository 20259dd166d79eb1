// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlBench: a bus of RtlStations, and when their software runs.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <queue>
#include <random>
#include <vector>

#include "bus/bus.hpp"
#include "timesync/rtl_station.hpp"
#include "timesync/rtl_traffic.hpp"
#include "timesync/sync_case.hpp"
#include "timesync/sync_run.hpp"

namespace vericansim {

/// Whether idle gaps are clocked, or skipped: same results (TM-121, TM-122).
enum class IdleGaps : std::uint8_t { kClocked, kSkipped };

/// Where the master's clock begins, ns, and how often in an interval all clocks are looked at.
inline constexpr std::uint64_t kMasterTime = 1'700'000'000'000'000'000;
inline constexpr int kLooks = 16;

/// The first station is the master. Software that runs at a time of its own is given to at(); a
/// handler runs behind each interrupt, after a latency that is drawn anew.
class RtlBench {
 public:
  /// Which identifiers the stations take, see RtlStation::start().
  struct Accepted {
    std::uint32_t id = 0, mask = 0;
  };

  /// `error_of(node)`: constant error of each oscillator, ppm.
  RtlBench(const SyncCase &setting, IdleGaps gaps, std::uint64_t seed,
           const std::function<double(unsigned)> &error_of, Accepted accepted);

  /// Software at bus time `when`, ps, or as soon as others let it.
  void at(Time when, std::function<void()> software);
  /// Runs up to `end`, ps.
  void run(Time end);

  /// All followers against the master now; `state_of(n)`, n from 1 on: verican_sync_state_t.
  [[nodiscard]] SyncLook look(const std::function<std::uint8_t(unsigned n)> &state_of);

  /// The handler of a station, called within latency_least..latency_most of the interrupt, ps.
  std::function<void(unsigned station)> handler;
  Time latency_least = 2 * kMicrosecond, latency_most = 6 * kMicrosecond;

  /// Called when an error frame of SyncCase::bit_errors begins.
  std::function<void()> on_error;
  /// Draws anew which followers see edges early (SyncCase::displaced), if the bus is silent.
  /// Without displaced edges: nothing.
  void displace();
  /// Of the cable from the master to each follower, ns: only as long as edges can be early.
  [[nodiscard]] std::int32_t delay_ns() const { return setting_.displaced > 0 ? kEarly : 0; }

  [[nodiscard]] double uniform(double low, double high);
  [[nodiscard]] RtlStation &station(unsigned n) { return *stations_[n]; }
  [[nodiscard]] unsigned size() const { return static_cast<unsigned>(stations_.size()); }
  Bus bus;

 private:
  // An edge comes early by that at most, ns.
  static constexpr std::int32_t kEarly = 300;

  struct Software {
    Time when;
    std::uint64_t order;
    std::function<void()> run;
    bool operator<(const Software &other) const {
      return when != other.when ? when > other.when : order > other.order;
    }
  };

  [[nodiscard]] ClockConfig clock_of(unsigned node, double error_ppm);
  void call_handlers();
  void advance(Time until);
  void skip(Time until);
  [[nodiscard]] bool stations_silent() const;
  [[nodiscard]] bool silent() const;

  SyncCase setting_;
  IdleGaps gaps_;
  Time bit_;
  std::mt19937_64 dice_;
  std::vector<std::unique_ptr<RtlStation>> stations_;
  std::vector<bool> called_;  // the handler is on its way
  std::priority_queue<Software> software_;
  std::uint64_t order_ = 0;
  std::unique_ptr<RtlTraffic> traffic_;
  Time calm_ = 0;  // from then on the bus has been idle long enough, if nobody sends
};

}  // namespace vericansim
