// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlNode: the whole core, Verilated, with a master of its bus on its host side.
#pragma once

#include <coroutine>
#include <cstdint>
#include <memory>
#include <string>

#include "bus/node.hpp"
#include "node/ahb_master.hpp"
#include "node/bus_master.hpp"

namespace vericansim {

/// Interrupt lines of the core as bits of RtlNode::irq_lines().
enum IrqLine : std::uint8_t {
  kIrqAll = 1 << 0,  ///< irq_o: OR of the others
  kIrqMb = 1 << 1,
  kIrqBusOff = 1 << 2,
  kIrqError = 1 << 3,
  kIrqTxWarning = 1 << 4,
  kIrqRxWarning = 1 << 5,
  kIrqWake = 1 << 6,
};

/// The whole core. Software on it is written as coroutines (task.hpp) that wait for accesses and
/// for interrupts, or, in tests, as plain calls of read32() and write32() that advance the
/// simulation.
class RtlNode : public Node {
 public:
  /// After the constructor the core has been reset. `num_mb`: 16, 32 or 64 message buffers
  /// (std::invalid_argument otherwise).
  static std::unique_ptr<RtlNode> create(std::string name, const ClockConfig &clock = {},
                                         unsigned num_mb = 64);
  /// One of 64 buffers with the time unit; its clock begins at 0 with 125 ns a clock, what 8 MHz
  /// need, until software sets another rate.
  static std::unique_ptr<RtlNode> create_with_time(std::string name, const ClockConfig &clock = {});

  /// Hard reset of the core and of the master; pending accesses are forgotten.
  virtual void reset() = 0;
  /// IrqLine bits as of the last clock edge.
  [[nodiscard]] virtual std::uint8_t irq_lines() const = 0;
  /// irq_time_o and time_out_o as of the last clock edge; false without the time unit.
  [[nodiscard]] virtual bool irq_time() const { return false; }
  [[nodiscard]] virtual bool time_out() const { return false; }
  /// TIME as of the last clock edge, ns. std::logic_error without the time unit.
  [[nodiscard]] virtual std::uint64_t time_of_clock() const;
  /// Level of ext_i from the next clock edge on. A reset does not change it.
  virtual void external(bool level) { (void)level; }
  /// Level of stop_req_i from the next clock edge on: the system asks for stop mode (flexcan.md
  /// 2.9). A reset does not change it.
  virtual void request_stop(bool stop) = 0;
  /// What a read that began now would return. Nothing happens to the core: it is done on a copy,
  /// behind a transfer that is under way; no time passes, no buffer is locked.
  [[nodiscard]] virtual AhbResult peek(const AhbTransfer &transfer) = 0;
  [[nodiscard]] bool irq() const { return (irq_lines() & kIrqAll) != 0; }
  [[nodiscard]] unsigned num_mb() const { return num_mb_; }
  /// Whatever drives the core's bus.
  [[nodiscard]] BusMaster &master() { return *master_; }
  [[nodiscard]] const BusMaster &master() const { return *master_; }
  /// The same of a core with AHB-Lite, which create() makes. std::logic_error for another.
  [[nodiscard]] AhbMaster &ahb() {
    if (master_ != &ahb_) no_ahb();
    return ahb_;
  }
  [[nodiscard]] const AhbMaster &ahb() const {
    if (master_ != &ahb_) no_ahb();
    return ahb_;
  }
  /// Clock edges since the constructor.
  [[nodiscard]] std::uint64_t cycles() const {
    catch_up();
    return cycles_;
  }
  /// The same without those that Bus::skip() has left out.
  [[nodiscard]] std::uint64_t clocked() const { return cycles() - left_out_; }

  // ---- Coroutines

  /// `co_await node.interrupt()` goes on when irq_o is high, `co_await node.delay(n)` after n
  /// clocks. One coroutine of a node can wait at a time.
  struct Waiter {
    RtlNode &node;
    bool for_irq;
    std::uint64_t until;  // cycle at which to go on in any case
    [[nodiscard]] bool await_ready() const { return for_irq && node.irq(); }
    void await_suspend(std::coroutine_handle<> handle) const;
    void await_resume() const {}
  };
  [[nodiscard]] Waiter interrupt() { return {*this, true, ~0ULL}; }
  /// Also goes on after `limit` clocks without an interrupt, or on wake().
  [[nodiscard]] Waiter interrupt(std::uint64_t limit) { return {*this, true, cycles() + limit}; }
  [[nodiscard]] Waiter delay(std::uint64_t clocks) { return {*this, false, cycles() + clocks}; }
  /// Lets a coroutine that waits for an interrupt or a delay go on at the next clock.
  void wake() {
    disturbed();
    wake_cycle_ = 0;
  }
  /// Forgets a coroutine that waits (before it is destroyed).
  void forget_waiter() { waiter_ = nullptr; }

  // ---- Blocking calls

  /// One access; runs the bus (or, without a bus, this node alone with a recessive pin) until it is
  /// done.
  AhbResult access(const AhbTransfer &transfer);
  /// As access(), for whole words. An ERROR response throws std::runtime_error.
  std::uint32_t read32(std::uint32_t address);
  void write32(std::uint32_t address, std::uint32_t data);
  /// Runs the bus by one instant, or this node by one clock if it is on no bus.
  void advance();

 protected:
  RtlNode(std::string name, const ClockConfig &clock, unsigned num_mb)
      : Node{std::move(name), clock}, ahb_{[this] { disturbed(); }}, num_mb_{num_mb} {}
  /// For a core with another bus: its master, which lives as long as the node.
  void take_master(BusMaster &master) { master_ = &master; }
  /// To be called after each clock edge; `irq_may_rise`: false if the interrupts are as before it.
  void after_edge(bool irq_may_rise = true) {
    ++cycles_;
    if (waiter_ && (cycles_ >= wake_cycle_ || (irq_may_rise && wait_irq_ && irq())))
      resume_waiter();
  }

  /// Edges before the one at which a coroutine goes on in any case.
  [[nodiscard]] std::uint64_t edges_to_waiter() const {
    if (!waiter_) return ~0ULL;
    return wake_cycle_ > cycles_ ? wake_cycle_ - cycles_ - 1 : 0;
  }
  /// Edges that pass() has made good.
  void passed(std::uint64_t edges) { cycles_ += edges; }
  /// Edges that Bus::skip() has left out.
  void left_out(std::uint64_t edges) {
    cycles_ += edges;
    left_out_ += edges;
  }

 private:
  void resume_waiter();
  [[noreturn]] void no_ahb() const;

  AhbMaster ahb_;
  BusMaster *master_ = &ahb_;
  unsigned num_mb_;
  std::uint64_t cycles_ = 0, left_out_ = 0;
  std::coroutine_handle<> waiter_ = nullptr;
  bool wait_irq_ = false;
  std::uint64_t wake_cycle_ = 0;
};

}  // namespace vericansim
