// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// World: the node under test with its driver, two healthy engines beside it, and what happens to
// them: a scene.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>

#include "node/core_node.hpp"
#include "softerror/driver.hpp"
#include "softerror/flop_node.hpp"
#include "softerror/frames.hpp"

namespace vericansim {

/// What goes on while the flip-flops flip.
enum class Scene : std::uint8_t {
  kTraffic,    ///< saturated bus, all three send
  kRegisters,  ///< the same, and a CPU that accesses buffers and registers all the time
  kErrors,     ///< the same with bits of the node under test disturbed: flags, error passive
  kModes,      ///< freeze, disable, stop, soft reset beside the traffic of the others
  kIdle,       ///< bus idle, then traffic
  kBusOff,     ///< the node under test goes bus-off and recovers
};
inline constexpr unsigned kScenes = 6;
[[nodiscard]] const char *to_string(Scene scene);

/// Everything that the judges of a run look at, as counts since the beginning.
struct Sight {
  unsigned errors = 0;            ///< error pulses of all nodes
  unsigned bus_offs = 0;          ///< of the node under test
  std::uint64_t last_error = 0;   ///< clock
  std::uint64_t longest_gap = 0;  ///< clocks without a good frame while a neighbour waits
  unsigned longest_run = 0;       ///< dominant at the pin, in tenths of the node's own bits
  bool run_too_long = false;      ///< longer than its errors explain
};

/// The three nodes on a wire, clock by clock. Their clocks differ by 0.1 %.
class World {
 public:
  /// The scene, its moments and the frames follow from `seed`.
  explicit World(std::uint64_t seed);

  /// One clock.
  void step();
  void run(std::uint64_t clocks) {
    for (std::uint64_t end = clock_ + clocks; clock_ < end;) step();
  }
  /// Runs until `done`; false if `limit` clocks have passed.
  bool run_until(const std::function<bool()> &done, std::uint64_t limit);

  [[nodiscard]] Scene scene() const { return scene_; }
  /// When a flip may come: the scene is under way between these two clocks.
  [[nodiscard]] std::uint64_t window_begin() const { return begin_; }
  [[nodiscard]] std::uint64_t window_end() const { return end_; }
  [[nodiscard]] std::uint64_t clock() const { return clock_; }
  [[nodiscard]] unsigned bit_clocks() const { return timing_.clocks_per_bit(); }

  /// Everybody sends as much as he can, or nothing new.
  void traffic(bool on);
  /// Everybody sends `count` frames more.
  void send(unsigned count);
  /// Nothing waits to be sent anywhere, and the driver has nothing to do.
  [[nodiscard]] bool quiet() const;
  /// Gives the driver an order and waits for its end; false if it never ends.
  bool order(Order what);
  /// Hard reset of the node under test, and a new driver.
  bool hard_reset();

  [[nodiscard]] FlopNode &dut() { return *dut_; }
  [[nodiscard]] SoftDriver &driver() { return *driver_; }
  [[nodiscard]] const Ledger &ledger() const { return ledger_; }
  [[nodiscard]] const Sight &sight() const { return sight_; }
  /// Level of the bus in the clock before.
  [[nodiscard]] Level level() const { return level_; }
  [[nodiscard]] const CoreNode &neighbour(unsigned n) const { return *neighbours_[n].node; }
  /// The hang of an AHB access: HREADYOUT is low for longer than any access takes.
  [[nodiscard]] bool ahb_hangs() const { return dut_->longest_wait() > 64; }

  /// Called after each clock, if set.
  std::function<void()> on_clock;

 private:
  struct Neighbour {
    std::unique_ptr<CoreNode> node;
    std::deque<FrameTag> waiting;
    unsigned quota = 0;
    std::size_t received = 0;
    std::size_t sent = 0;
  };

  void new_driver();
  void plan();
  void at(std::uint64_t offset, std::function<void()> action);
  void leave(Order how, std::uint64_t offset, std::uint64_t back);
  void clock_neighbour(unsigned n, Level rx);
  [[nodiscard]] Level dut_level(Level bus) const;
  void watch();
  void watch_pin(std::uint64_t trace);

  std::uint64_t seed_;
  Scene scene_;
  BitTiming timing_;
  Ledger ledger_;
  std::unique_ptr<FlopNode> dut_;
  std::unique_ptr<SoftDriver> driver_;
  std::array<Neighbour, 2> neighbours_;
  std::deque<std::pair<std::uint64_t, std::function<void()>>> events_;
  std::uint64_t clock_ = 0;
  std::uint64_t begin_ = 0;
  std::uint64_t end_ = 0;
  std::uint64_t excused_until_ = 0;
  std::uint64_t noise_until_ = 0;
  std::uint64_t deaf_from_ = 0;
  std::uint64_t deaf_until_ = 0;
  std::uint64_t last_good_ = 0;
  Level level_ = Level::kRecessive;
  Sight sight_;
  unsigned run_clocks_ = 0;
  unsigned run_errors_ = 0;
  bool was_off_ = false;
};

}  // namespace vericansim
