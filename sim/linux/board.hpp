// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Board: what a guest kernel finds at its register window: Verilated controllers on one bus, and a
// bench with faults, a peer and judges that its test scripts command.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bus/bus.hpp"
#include "linux/switch_fault.hpp"
#include "model/bus_monitor.hpp"
#include "node/core_node.hpp"
#include "node/rtl_node.hpp"
#include "node/time_node.hpp"
#include "trace/candump.hpp"
#include "trace/output_file.hpp"

namespace vericansim {

/// Settings of a Board.
struct BoardConfig {
  unsigned controllers = 2;  ///< 1..8; each has a window of 4 KiB, and the line of its number
  double clock_hz = 8e6;     ///< of the controllers, 1 kHz to 10 GHz
  /// Error of each controller's clock, within +-100,000 ppm; those that are not named have none.
  std::vector<double> clock_ppm = {};
  /// With the time unit: each window has 8 KiB, and irq_time_o of controller n is line 8 + n.
  bool time_unit = false;
  /// Cores of create_lean_core(); not together with time_unit.
  bool lean = false;
  std::string directory;     ///< for logs, there when they are whole; empty: none are written
  bool access_logs = false;  ///< write each access to access-<n>.txt
};

/// An access of the guest.
struct BoardAccess {
  std::uint32_t address = 0;  ///< within the windows, which follow each other: 4 KiB or 8 KiB each
  bool write = false;
  std::uint32_t value = 0;  ///< to write
  unsigned size = 4;        ///< bytes: 1, 2 or 4
};

/// Ways in which a Board can be made to lie to its guest, so that tests can be seen to fail.
struct Sabotage {
  bool lose_frame = false;     ///< the next received frame is thrown away behind the driver's back
  bool corrupt_data = false;   ///< a bit is inverted in the first byte of the next data word read
  bool frozen_errors = false;  ///< ECR always reads 0
  bool deaf = false;           ///< the interrupt lines stay low
};

/// The board. Its time is that of the guest: it goes on from access to access and in run_until(),
/// and passes without a clock edge while no controller is enabled and nothing else happens. Time
/// units are clocked always; while nothing else happens in closed form (TimeNode).
class Board {
 public:
  /// Throws std::invalid_argument if a setting is out of range, OutputError if a log of accesses
  /// cannot be written.
  explicit Board(const BoardConfig &config);

  /// One AHB transfer, now. All ones for an address outside the windows and for an ERROR response.
  std::uint32_t access(const BoardAccess &access);
  /// Lets time pass until `when` (ns, as now()). True at once when an interrupt line has risen
  /// since the last call of levels().
  bool run_until(std::uint64_t when);
  /// Bit n: the line of controller n is high; bit 8 + n: that of its time unit.
  [[nodiscard]] std::uint32_t levels();
  /// Time that has passed, ns.
  [[nodiscard]] std::uint64_t now() const {
    return static_cast<std::uint64_t>((now_ + skipped_) / kNanosecond);
  }
  /// A line of text from a test script (docs/software.md); the answer, of one or more lines. Throws
  /// InputError if it is none that exists or if a value is out of range.
  std::string command(const std::string &text);
  /// Puts the logs in their place; throws OutputError if not all could be written.
  void close_logs();

  [[nodiscard]] const RtlNode &controller(unsigned n) const { return *cores_[n]; }
  /// Time that has passed without clock edges, ns.
  [[nodiscard]] std::uint64_t asleep() const {
    return static_cast<std::uint64_t>(skipped_ / kNanosecond);
  }

 private:
  using Words = std::vector<std::string_view>;

  void add_controllers();
  [[nodiscard]] std::uint32_t window() const { return time_units_.empty() ? 0x1000 : 0x2000; }
  [[nodiscard]] std::uint32_t lines() const;
  [[nodiscard]] bool idle() const;
  std::uint32_t transfer(RtlNode &core, const BoardAccess &access, std::uint32_t offset);
  void close_frame_log();
  [[nodiscard]] std::unique_ptr<OutputFile> open_log(const std::string &name) const;
  void toggle_at(TimeNode &node, Time when, Time half, std::uint64_t changes);
  void lose_frame(RtlNode &core, std::uint32_t offset);
  void log_access(unsigned n, std::uint32_t offset, const BoardAccess &access, std::uint32_t value);

  std::string observe(const Words &words);
  std::string log(const Words &words);
  std::string report();
  std::string hold(const Words &words);
  std::string cut(const Words &words);
  std::string strike(const Words &words);
  std::string peer(const Words &words);
  std::string sabotage(const Words &words);
  std::string pulse(const Words &words);
  std::string edges(const Words &words);
  void watch_bus();
  void start_peer();
  [[nodiscard]] SwitchFault &faults();
  [[nodiscard]] NodeId node_named(std::string_view name) const;
  [[nodiscard]] TimeNode &time_unit(std::string_view name);
  [[nodiscard]] std::string node_name(NodeId id) const;

  BoardConfig config_;
  std::vector<std::unique_ptr<RtlNode>> cores_;
  std::vector<TimeNode *> time_units_;  // those of cores_, if they have them
  std::unique_ptr<CoreNode> peer_;
  SwitchFault fault_;
  std::unique_ptr<BusMonitor> monitor_;
  std::unique_ptr<OutputFile> log_file_;
  std::unique_ptr<CandumpWriter> log_;
  std::vector<std::unique_ptr<OutputFile>> access_logs_;
  Sabotage sabotage_;
  bool faulty_ = false;  // fault_ is on the bus
  std::uint32_t bitrate_ = 500'000;
  std::uint32_t told_ = 0;  // levels that the guest knows
  std::uint64_t bus_errors_ = 0;
  Time observed_since_ = 0;  // of the guest's time, ps
  Time now_ = 0;             // time of the bus, ps
  Time skipped_ = 0;         // time that the bus has not seen, ps
  Time touched_ = 0;         // time of the bus at the last access or command
  Bus bus_;
};

}  // namespace vericansim
