// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SoftDriver: the software on the node under test: Rx FIFO for extended frames, a queue of
// mailboxes for base frames, eight transmit buffers, interrupts; and what a driver does when the
// controller seems stuck.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "node/bit_timing.hpp"
#include "node/rtl_node.hpp"
#include "node/task.hpp"
#include "softerror/frames.hpp"

namespace vericansim {

/// What the software is asked to do, beside its daily work.
enum class Order : std::uint8_t {
  kNone,
  kFreeze,       ///< and stay there
  kRun,          ///< leave freeze or disable mode
  kDisable,      ///< and stay there
  kRenew,        ///< clear flags, unlock, give all buffers their codes again
  kReconfigure,  ///< freeze, write the whole configuration anew, run
  kSoftReset,    ///< soft reset, then the set-up from the beginning
};

/// The registers that a driver writes once, and what they held when it looked again.
struct ConfigCheck {
  unsigned wrong = 0;  ///< registers that have changed
};

/// The driver. All loops in it are bounded: if the controller does not answer, it says so.
class SoftDriver {
 public:
  static constexpr unsigned kTxBuffers = 8;

  SoftDriver(RtlNode &node, const BitTiming &timing, Ledger &ledger);
  ~SoftDriver();
  SoftDriver(const SoftDriver &) = delete;
  SoftDriver &operator=(const SoftDriver &) = delete;

  /// Lets the set-up begin; afterwards the driver serves its interrupts for ever.
  void start();
  [[nodiscard]] bool ready() const { return ready_; }
  /// Gives an order; it is done when order() is kNone again.
  void give(Order order);
  [[nodiscard]] Order order() const { return order_; }
  /// Keeps the transmit buffers filled with new frames, up to `count` of them in all.
  void send(unsigned count);
  /// Frames that are to be sent and have not ended.
  [[nodiscard]] unsigned pending() const;
  /// Between interrupts, accesses registers and buffers at random.
  void set_restless(bool restless) { restless_ = restless; }
  /// Reads the configuration back and the status registers; result by checked().
  void inspect();
  [[nodiscard]] bool inspected() const { return !inspecting_; }
  [[nodiscard]] unsigned config_wrong() const { return config_wrong_; }
  [[nodiscard]] const std::vector<std::uint32_t> &status() const { return status_; }

  /// Losses that the controller has told: overruns of mailboxes and of the FIFO.
  [[nodiscard]] unsigned overruns() const { return overruns_; }
  /// Bus errors, and mode changes that were not acknowledged in time.
  [[nodiscard]] unsigned bus_errors() const { return bus_errors_; }
  [[nodiscard]] unsigned unanswered() const { return unanswered_; }

  /// Called when a frame has been received.
  std::function<void(const Frame &)> on_received;

 private:
  struct Slot {
    bool busy = false;
    bool abort = false;
    FrameTag tag;
  };

  Task<> main();
  Task<> obey();
  Task<> set_up();
  Task<> configure();
  Task<> start_clock();
  Task<> renew();
  Task<> wait_for(std::uint32_t mask, std::uint32_t value);
  Task<> load();
  Task<> serve();
  Task<> serve_fifo();
  Task<> serve_mailbox(unsigned mb);
  Task<> serve_sent(unsigned slot);
  Task<> look_around();
  Task<> look_at_everything();
  Task<std::uint32_t> read(std::uint32_t address);
  Task<> activate(unsigned slot);
  void write(std::uint32_t address, std::uint32_t data);
  void requeue();

  RtlNode &node_;
  BitTiming timing_;
  Ledger &ledger_;
  std::array<Slot, kTxBuffers> slots_;
  std::vector<FrameTag> waiting_;
  unsigned to_send_ = 0;
  unsigned loads_ = 0;
  std::uint64_t random_ = 1;
  Order order_ = Order::kNone;
  bool ready_ = false;
  bool restless_ = false;
  bool inspecting_ = false;
  unsigned config_wrong_ = 0;
  std::vector<std::uint32_t> status_;
  unsigned overruns_ = 0;
  unsigned bus_errors_ = 0;
  unsigned unanswered_ = 0;
  Task<> main_;
};

}  // namespace vericansim
