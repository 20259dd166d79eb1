// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimedEngine: can_core with its time unit as two Verilated models, so that the unit rests while it
// only counts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include "Vcan_core_time.h"
#include "Vcan_core_time___024root.h"
#include "Vcan_time_unit.h"
#include "Vcan_time_unit___024root.h"
#include "core_ports.hpp"
#include "node/model_edge.hpp"
#include "node/time_flops.hpp"

namespace vericansim {

/// An engine whose can_time is hollow (cmake/split_core.py), and can_time, clocked together. The
/// unit moves in every clock, but most of the time it only counts, whatever the engine does; any
/// number of such clocks is a multiplication (TimeFlops), which is put off until the unit has to be
/// looked at: for a command, a compare or launch that is due, an edge of the bus whose time may be
/// taken, or another part of the frame. Proven member by member in
/// tb/system/bus_quiet_engine_test.cpp, in every clock in bus_split_core_test.cpp.
class TimedEngine : public Vcan_core_time {
  Vcan_time_unit unit_;

 public:
  TimedEngine(VerilatedContext *context, const char *name)
      : Vcan_core_time{context, name}, unit_{context, (std::string{name} + "_time").c_str()} {}

  // Outputs that the engine only hands on: those of the unit.
  const QData &time_now_o = unit_.now_o, &time_ext_o = unit_.ext_o, &time_stamp_o = unit_.stamp_o;
  const IData &time_left_o = unit_.left_o;
  const CData &time_stamp_we_o = unit_.stamp_we_o, &time_stamp_tx_o = unit_.stamp_tx_o;

  /// Lets what is combinational follow the inputs.
  void eval() {
    Vcan_core_time::eval();
    if (host_changed()) still_ = false;
  }

  /// One rising edge; `settled`: no input has changed but those that only flip-flops look at.
  void edge(bool settled) {
    const bool counts = settled && edges_of_time() != 0;
    if (counts)
      pass_time(1);
    else
      unit_edge();
    Vcan_core_time &engine = *this;
    if (settled && !kPlainEdges)
      settled_edge(engine);
    else
      rising_edge(engine, clk_i);
    show_unit(!counts);
  }

  /// Edges to come in which the unit only counts, as long as no input and no level changes.
  [[nodiscard]] std::uint64_t edges_of_time() const {
    return still_ && stamp_rests(*unit_.rootp) ? rest_ - behind_ : 0;
  }

  /// Whether the unit ever rests: not if the model lacks members that are looked at.
  [[nodiscard]] static constexpr bool in_force() { return kKnown<Root>; }

  /// `edges` of them have passed, with the levels of now.
  void pass_time(std::uint64_t edges) {
    if (edges == 0) return;
    behind_ += edges;
    follow_levels(*unit_.rootp);
  }

  /// TIME. std::logic_error for a model that does not show its registers.
  [[nodiscard]] std::uint64_t time() const { return time_of(*unit_.rootp); }

  /// Whether clocks in which the unit only counts are left out (by default they are).
  void let_time_rest(bool allowed) {
    catch_up_time();
    rests_ = allowed;
    still_ = false;
  }

  /// The unit does what it has left out, with the engine's levels of now at its inputs.
  Vcan_time_unit &settled_unit() {
    catch_up_time();
    TimeUnitPorts::to_core(unit_, *rootp);
    unit_.eval();
    still_ = false;
    return unit_;
  }

  /// All that the unit remembers, and the same again.
  [[nodiscard]] std::unique_ptr<unsigned char[]> save_unit() {
    catch_up_time();
    return snapshot();
  }
  void restore_unit(const unsigned char *state) {
    std::memcpy(static_cast<void *>(unit_.rootp), state, sizeof(*unit_.rootp));
    behind_ = 0;
    still_ = false;
  }

 private:
  using Root = Vcan_time_unit___024root;

  // Members that Verilator 5.006 gives the model. Without the clock's TIME cannot be looked at;
  // without any of them, or without short cuts, the unit never rests.
  template <typename R>
  static constexpr bool kShowsTime = requires(R &root) {
    VERICAN_TIME_FLOPS(root, can_time, left_o);
  };
  template <typename R>
  static constexpr bool kKnown = !kPlainEdges && kShowsTime<R> && requires(R & root) {
    root.stamp_o;
    root.can_time__DOT__u_stamp__DOT__rx_q;
    root.can_time__DOT__u_stamp__DOT__tx_q;
    root.can_time__DOT__u_stamp__DOT__last_q;
    root.can_time__DOT__u_stamp__DOT__fixed_q;
  };
    // A level of the engine at the unit's inputs.
#define VERICAN_LEVEL(name) rootp->VERICAN_AT_TIME_UNIT(name)

  // What the host side tells the unit is not what it was at the last edge that was evaluated.
  [[nodiscard]] bool host_changed() const {
    return VERICAN_LEVEL(cmd_i) != unit_.cmd_i || VERICAN_LEVEL(data_i) != unit_.data_i ||
           VERICAN_LEVEL(tctrl_i) != unit_.tctrl_i || VERICAN_LEVEL(tcmph_i) != unit_.tcmph_i ||
           VERICAN_LEVEL(ttx_i) != unit_.ttx_i;
  }

  // Nothing happens to the stamp (rtl/time/can_stamp.sv) in the next edge: it is the same part of
  // the frame as in the last one that was evaluated, no pulse comes, and unless the stamp stands
  // fast no level falls and no bit may be the reference bit.
  template <typename R>
  [[nodiscard]] bool stamp_rests(const R &unit) const {
    if constexpr (kKnown<R>) {
      const unsigned part = unsigned{VERICAN_LEVEL(field_i)} ^ unit_.field_i;
      if (part >> 3 != 0 || (VERICAN_LEVEL(sof_i) | VERICAN_LEVEL(rx_valid_i)) != 0) return false;
      if (unit.can_time__DOT__u_stamp__DOT__fixed_q != 0) return true;
      constexpr unsigned kBehindId = 2;
      const unsigned falls =
          (unit.can_time__DOT__u_stamp__DOT__rx_q & ~unsigned{VERICAN_LEVEL(rx_i)}) |
          (unit.can_time__DOT__u_stamp__DOT__tx_q & ~unsigned{VERICAN_LEVEL(tx_i)});
      const bool reference = unit_.field_i >> 3 == kBehindId && VERICAN_LEVEL(sample_i) != 0 &&
                             VERICAN_LEVEL(bit_i) == 0;
      return falls == 0 && !reference;
    } else {
      return false;
    }
  }

  template <typename R>
  void follow_levels(R &unit) {
    if constexpr (kKnown<R>) {
      unit.can_time__DOT__u_stamp__DOT__rx_q = VERICAN_LEVEL(rx_i);
      unit.can_time__DOT__u_stamp__DOT__tx_q = VERICAN_LEVEL(tx_i);
      if (VERICAN_LEVEL(sample_i) != 0)
        unit.can_time__DOT__u_stamp__DOT__last_q = VERICAN_LEVEL(bit_i);
    }
  }

  // The next edge of the engine is one of the unit, too.
  void unit_edge() {
    catch_up_time();
    TimeUnitPorts::to_core(unit_, *rootp);
    unit_.rst_ni = rst_ni;
    std::memcpy(before_.get(), static_cast<const void *>(unit_.rootp), sizeof(Root));
    rising_edge(unit_, unit_.clk_i);
    look(*reinterpret_cast<Root *>(before_.get()), *unit_.rootp);
  }

  // Whether, and how long, the next edges do nothing but count and follow the levels: that is all
  // that the last one did, and perhaps it took a time.
  template <typename R>
  void look(R &before, R &after) {
    if constexpr (kKnown<R>) {
      const TimeFlops flops = VERICAN_TIME_FLOPS(after, can_time, left_o);
      VERICAN_TIME_FLOPS(before, can_time, left_o).copy_moving(flops);
      before.can_time__DOT__u_stamp__DOT__rx_q = after.can_time__DOT__u_stamp__DOT__rx_q;
      before.can_time__DOT__u_stamp__DOT__tx_q = after.can_time__DOT__u_stamp__DOT__tx_q;
      before.can_time__DOT__u_stamp__DOT__last_q = after.can_time__DOT__u_stamp__DOT__last_q;
      before.stamp_o = after.stamp_o;
      still_ = rests_ && unit_.cmd_i == 0 &&
               std::memcmp(static_cast<const void *>(&before), static_cast<const void *>(&after),
                           sizeof(R)) == 0;
      rest_ = std::min(flops.clocks_before_compare(),
                       flops.held != 0 ? flops.clocks_before(unit_.ttx_i) : TimeFlops::kForever);
    }
  }

  void catch_up_time() { catch_up_with(*unit_.rootp); }

  // The last edges are done one by one, on quiet levels: what follows the clock follows it in them.
  template <typename R>
  void catch_up_with(R &unit) {
    if constexpr (kKnown<R>) {
      if (behind_ == 0) return;
      unit_.rx_i = unit.can_time__DOT__u_stamp__DOT__rx_q;
      unit_.tx_i = unit.can_time__DOT__u_stamp__DOT__tx_q;
      unit_.sample_i = unit_.sof_i = unit_.rx_valid_i = 0;
      if (behind_ > TimeFlops::kFollow) {
        VERICAN_TIME_FLOPS(unit, can_time, left_o).leap(behind_ - TimeFlops::kFollow);
        behind_ = TimeFlops::kFollow;
      }
      rising_edge(unit_, unit_.clk_i);
      while (--behind_ > 0) settled_edge(unit_);
    }
  }

  template <typename R>
  [[nodiscard]] std::uint64_t time_of(R &unit) const {
    if constexpr (kShowsTime<R>) {
      return VERICAN_TIME_FLOPS(unit, can_time, left_o).time_after(behind_);
    } else {
      throw std::logic_error("the clock of this model cannot be looked at");
    }
  }

  // What the unit shows the engine; all that it shows is of flip-flops, but whose frame it is.
  void show_unit(bool moved) {
    const bool role = VERICAN_LEVEL(transmitter_i) != unit_.transmitter_i;
    if (!moved && !role) return;
    if (role) {
      unit_.transmitter_i = VERICAN_LEVEL(transmitter_i);
      unit_.eval();
    }
    if (TimeUnitPorts::to_host(unit_, *rootp)) Vcan_core_time::eval();
  }
#undef VERICAN_LEVEL

  [[nodiscard]] std::unique_ptr<unsigned char[]> snapshot() const {
    auto bytes = std::make_unique<unsigned char[]>(sizeof(Root));
    std::memcpy(bytes.get(), static_cast<const void *>(unit_.rootp), sizeof(Root));
    return bytes;
  }

  std::unique_ptr<unsigned char[]> before_ = std::make_unique<unsigned char[]>(sizeof(Root));
  std::uint64_t behind_ = 0;  // edges that the unit has left out
  std::uint64_t rest_ = 0;    // while still_: edges that it may, behind_ of them have been
  bool still_ = false;        // its last edge moved nothing but what counts
  bool rests_ = true;
};

/// As for any model (model_edge.hpp), of both.
template <typename Signal>
inline void rising_edge(TimedEngine &engine, Signal & /*clk_i*/) {
  engine.edge(false);
}
inline void settled_edge(TimedEngine &engine) { engine.edge(true); }

}  // namespace vericansim
