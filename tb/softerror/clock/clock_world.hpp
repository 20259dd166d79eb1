// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ClockWorld: a core with the time unit whose flip-flops can be flipped, the C driver on it, an
// ideal master and one more node; what their software does in each scene.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "driver/driver_node.hpp"
#include "node/core_node.hpp"
#include "softerror/clock/pair_source.hpp"
#include "softerror/flop_node.hpp"
#include "verican/timesync.h"
#include "verican/verican_regs.h"

namespace vericansim {

enum class ClockScene : std::uint8_t {
  kTime,    ///< the node follows the master (TM-80 to TM-88)
  kLaunch,  ///< it sends a frame at a time, again and again (TM-40)
};

/// Clocks of the node: 4 MHz, 60 ppm fast, 8 a bit.
inline constexpr double kNodeHz = 4e6;
inline constexpr double kBitrate = 500e3;
inline constexpr Time kBit = 2 * kMicrosecond;
/// Between two pairs, and between two launches.
inline constexpr Time kPairs = 50 * kMillisecond, kLaunches = 2 * kMillisecond;
/// The first of them, bus time.
inline constexpr Time kFirst = 5 * kMillisecond;
/// A launch is asked for this long before it, ns of TIME.
inline constexpr std::uint64_t kLaunchIn = 400'000;
/// TIME counts as right within three clocks, ns.
inline constexpr double kRight = 750;

class ClockWorld {
 public:
  explicit ClockWorld(ClockScene scene);

  /// One instant of the bus, and the software that is due.
  void step();
  void run_to(Time end);
  void run(Time duration) { run_to(bus.now() + duration); }
  /// False if `limit` (from now) came first.
  bool run_until(const std::function<bool()> &done, Time limit);

  /// TIME less the master's, ns.
  [[nodiscard]] double error() const;
  /// TIME, ns, as it was, or will be if nothing changes it, at bus time `at`, ps.
  [[nodiscard]] std::uint64_t time_at(Time at) const;

  std::uint32_t read(std::uint32_t offset);
  void write(std::uint32_t offset, std::uint32_t value);
  /// What software may write anew at any time: TCTRL, the increment, no slew, no launch, no flag.
  void rewrite();
  /// Soft reset, and everything anew.
  void set_up();
  /// Hard reset of the core before that.
  void reset();
  /// Asks the driver for VERICAN_CLOCK_* events instead of those before; forgets what it told.
  void ask(std::uint32_t events);
  /// No more launches but the one under way.
  void last_launch();
  /// Nothing more of the scene: what is to happen, who calls says.
  void end_scene();

  /// A digest of core and driver; equal digests mean an equal future.
  [[nodiscard]] std::uint64_t state() const;
  [[nodiscard]] FlopNode &dut() { return *dut_; }
  [[nodiscard]] verican_t *dev() { return &node_.dev; }
  /// What the driver told of frames that were sent.
  [[nodiscard]] const std::vector<verican_tx_event_t> &sent() const { return node_.events; }
  [[nodiscard]] bool babbled() const { return longest_dominant_ > kLongestDominant; }

  /// Called when an access of the driver does not end.
  std::function<void()> on_hang;

  /// Edge of the pulse output.
  struct Pulse {
    Time at;
    bool level;
  };
  std::vector<Pulse> pulses;
  std::vector<verican_frame_t> others;  ///< received, none of the domain
  std::uint32_t clock_flags = 0;        ///< TSTAT flags that the driver told
  std::uint64_t event_time = 0;         ///< of the last edge that it told
  std::uint8_t servo_events = 0;        ///< VERICAN_SERVO_* but ACCEPTED
  unsigned launches = 0;                ///< asked for
  Time sof = 0;                         ///< the node began to send
  double worst = 0;                     ///< largest error() when software looked, ns
  unsigned pairs = 0;                   ///< SYNCs so far
  Time next_pair = 0;                   ///< when the next one is due

  Bus bus;
  PairSource source;
  CoreNode other;
  verican_tsyn_t tsyn{};

 private:
  // A node sends at most six dominant bits in a row, and an error in its flag makes it begin again:
  // twice that is more than any rule allows a node that is alone in it.
  static constexpr Time kLongestDominant = 24 * kBit;

  AhbResult access(const AhbTransfer &transfer);
  void step_bus();
  void watch();
  void play();
  void software();
  void follow();
  void launch();

  ClockScene scene_;
  FlopNode *dut_;
  DriverNode node_;
  bool over_ = false;
  Time next_follow_up_ = 0, next_software_ = 0, next_launch_ = 0;
  Time recessive_since_ = 0, dominant_since_ = 0, longest_dominant_ = 0;
  bool dominant_ = false, out_ = false;
};

}  // namespace vericansim
