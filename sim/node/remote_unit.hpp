// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteUnit: a CAN node without a processor on a bus, whatever it is made of.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "bus/node.hpp"
#include "model/remote_model.hpp"

namespace vericansim {

/// can_remote with its user port: what scenarios, tests and tools see of such a node. After its
/// constructor it has been reset and its memory cleared, and it is off the bus.
class RemoteUnit : public Node {
 public:
  /// start_i: joins the bus, with the number and the flags of its configuration.
  virtual void start() = 0;
  /// The byte that a bus read of `address` (0..FFF) would see now; 0 where nothing is. No time
  /// passes.
  [[nodiscard]] virtual std::uint8_t peek(unsigned address) const = 0;
  [[nodiscard]] virtual RemoteState state() const = 0;
  /// safe_o.
  [[nodiscard]] bool safe() const { return state() != RemoteState::kOperate; }
  /// True if nothing is under way and nothing waits to be sent: only its timers may change that.
  [[nodiscard]] virtual bool idle() const = 0;

  /// A write of user logic, as soon as its port is ready, in the order of the calls: the bytes of
  /// word `index` whose bit in `lanes` is set.
  virtual void user_write(unsigned index, std::uint32_t data, unsigned lanes) = 0;
  /// usr_hold_i.
  virtual void hold(bool on) = 0;
  /// event_i[k] for one clock.
  virtual void event(unsigned k) = 0;

  // Its timers count clocks.
  [[nodiscard]] std::uint64_t skip_most() const override { return 0; }

  /// Called in the clock edge in which a pulse of written_o or apply_o begins.
  std::function<void(const RemotePulse &)> on_pulse;

  /// Clock edges since the constructor.
  [[nodiscard]] std::uint64_t cycles() const {
    catch_up();
    return cycles_;
  }
  /// The same without those that Bus::skip() has left out.
  [[nodiscard]] std::uint64_t clocked() const { return cycles() - left_out_; }

 protected:
  RemoteUnit(std::string name, const ClockConfig &clock) : Node{std::move(name), clock} {}
  /// To be called for each clock edge.
  void count_edges(std::uint64_t edges) { cycles_ += edges; }
  /// To be called for those that Bus::skip() leaves out, too.
  void left_out(std::uint64_t edges) { left_out_ += edges; }

 private:
  std::uint64_t cycles_ = 0, left_out_ = 0;
};

}  // namespace vericansim
