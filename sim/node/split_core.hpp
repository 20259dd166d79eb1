// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SplitCore: can_ahb or can_remote as two Verilated models, so that the host side rests while
// nothing happens to it.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>

#include "Vcan_core.h"
#include "Vcan_core___024root.h"
#include "core_ports.hpp"
#include "node/byte_store.hpp"
#include "node/engine_time.hpp"
#include "node/host_image.hpp"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/tick_rest.hpp"
#include "node/transmit_scan.hpp"
#include "verilated.h"

namespace vericansim {

/// The engine (Engine) and a top whose engine is hollow (HostModel, cmake/split_core.py),
/// clocked together; `Ports` knows where in the top the engine is. Registers and buffers are three
/// quarters of the work of a clock and idle in most of them: when a clock edge has left every bit
/// of the model as it was, no further edge can change anything until an input does, and the model
/// is not evaluated. Nor is it while only a pass over its buffers goes on (TransmitScan), which is
/// made good afterwards, or for a byte that is received (ByteStore), or for a sample point that it
/// does not mind (TickRest). The result is that of the whole core in every clock
/// (tb/system/bus_split_core_test.cpp).
template <typename HostModel, typename Ports = AhbPorts, typename Engine = Vcan_core>
class SplitCore {
 public:
  using Root = std::remove_reference_t<decltype(*std::declval<HostModel &>().rootp)>;

  SplitCore() = default;
  // Verilator 5.006 removes a model's scopes from the context that was last in use on this thread,
  // which may be that of another node and gone.
  ~SplitCore() { Verilated::threadContextp(&context_); }
  SplitCore(const SplitCore &) = delete;
  SplitCore &operator=(const SplitCore &) = delete;

  /// Host side pins; after changing one of its inputs call settle() or touch(), and do not keep the
  /// reference beyond an edge: what has been left out was done with the inputs of then.
  [[nodiscard]] HostModel &host() {
    catch_up();
    return host_;
  }
  [[nodiscard]] const HostModel &host() const { return host_; }
  /// Engine: CAN pins and trace.
  [[nodiscard]] Engine &engine() { return engine_; }
  [[nodiscard]] const Engine &engine() const { return engine_; }

  /// The host side's inputs have changed.
  void touch() {
    catch_up();
    ticks_.forget();
    resting_ = host_settled_ = false;
  }

  /// The host side rests: nothing in it moves for the next rest() edges, or until an input of it
  /// does.
  [[nodiscard]] bool resting() const { return resting_; }
  [[nodiscard]] std::uint64_t rest() const { return resting_ ? rest_ : 0; }
  /// The engine shows something at which the resting host side has to wake.
  [[nodiscard]] bool wakes() const {
    engine_moved_ = engine_moved_ && Ports::wakes_host(engine_, *host_.rootp) &&
                    !ticks_.ignores(engine_, *host_.rootp);
    return engine_moved_;
  }
  /// The resting host side does not wake for sample points (of a node without a processor).
  [[nodiscard]] bool ignores_ticks() const { return resting_ && ticks_.learned(); }

  /// `edges` pass at rest, at most rest(). To be called before the engine does them where ticks may
  /// be ignored: whether one shows is that of before.
  void pass(std::uint64_t edges) {
    in_a_row_ = 0;
    if constexpr (TickRest<Root, Ports>::in_force())
      if (edges != 0) tick_ignored_ = edges == 1 && ticks_.learned() && engine_.tick_o != 0;
    engine_counted();
    storing_ = storing_ && edges == 0;
    if (rest_ == kForever) return;
    rest_ -= edges;
    behind_ += edges;
  }

  /// Lets the host side do what it has left out; its outputs stay as they are.
  void catch_up() {
    if constexpr (TickRest<Root, Ports>::in_force())
      if (std::exchange(tick_ignored_, false)) see_tick();
    host_moved_ = host_moved_ || behind_ != 0 || stored_;
    if (behind_ != 0) TransmitScan<Root>::pass(*host_.rootp, std::exchange(behind_, 0));
    if (!stored_) return;
    stored_ = false;
    if (std::exchange(storing_, false)) {
      store_.undo(*host_.rootp);
      settled_edge(host_);
    } else {
      settle_host();
    }
  }

  /// Whether passes over the buffers, and bytes, are left out (by default they are).
  void let_work_rest(bool passes, bool bytes) {
    passes_rest_ = passes;
    bytes_rest_ = bytes;
  }

  /// Lets combinational outputs follow the inputs, across both models.
  void settle() {
    in_a_row_ = 0;
    catch_up();
    ticks_.forget();
    resting_ = false;
    Ports::to_host(engine_, *host_.rootp);
    follow();
  }

  /// One rising edge of the clock behind which the host side's inputs change again, so that nobody
  /// asks whether it rests.
  void busy_edge() {
    in_a_row_ = 0;
    catch_up();
    ticks_.forget();
    if (Ports::to_host(engine_, *host_.rootp)) follow();
    host_edge();
    resting_ = false;
    engine_edge();
    show_engine();
  }

  /// One rising edge of the clock.
  void edge() {
    edge([this] { engine_edge(); });
  }
  /// The same, where `of_engine` does the engine's part, as long as the engine's inputs stay as
  /// they are; false: they have changed, and the engine was evaluated.
  template <typename OfEngine>
  bool edge(OfEngine &&of_engine) {
    if (rest() > 0 && !wakes()) {
      pass(1);
      of_engine();
      return true;
    }
    if (rest() == kForever && bytes_rest_ && !storing_ && store_.begin(engine_, *host_.rootp)) {
      storing_ = stored_ = true;
      in_a_row_ = 0;
      engine_counted();
      of_engine();
      return true;
    }
    catch_up();
    ticks_.begin(engine_, *host_.rootp, resting_ && rest_ == kForever);
    if (Ports::to_host(engine_, *host_.rootp)) {
      in_a_row_ = 0;
      follow();
    }
    std::swap(before_, earlier_);
    before_.take(*host_.rootp);
    host_edge();
    ++in_a_row_;
    begin_rest();
    const bool as_before = !engine_disturbed_;
    engine_counted();
    if (as_before)
      of_engine();
    else
      engine_edge();
    if (show_engine()) ticks_.forget();
    return as_before;
  }

  /// Whether an input of the engine other than can_rx_i has changed since the last call.
  [[nodiscard]] bool take_engine_disturbed() { return std::exchange(engine_disturbed_, false); }

  /// Whether the host side was evaluated since the last call: if not, its outputs are as they were.
  [[nodiscard]] bool take_host_moved() { return std::exchange(host_moved_, false); }

  /// Everything that the two models remember.
  struct State {
    std::unique_ptr<unsigned char[]> engine, host, unit;
    std::uint64_t rest;
    bool resting, host_settled, engine_settled;
  };
  [[nodiscard]] State save() {
    catch_up();
    std::unique_ptr<unsigned char[]> unit;
    if constexpr (kHasTimeUnit<Engine>) unit = engine_.save_unit();
    return {copy_of(*engine_.rootp), copy_of(*host_.rootp), std::move(unit), rest_, resting_,
            host_settled_,           engine_settled_};
  }
  void restore(const State &state) {
    std::memcpy(static_cast<void *>(engine_.rootp), state.engine.get(), sizeof(*engine_.rootp));
    std::memcpy(static_cast<void *>(host_.rootp), state.host.get(), sizeof(Root));
    if constexpr (kHasTimeUnit<Engine>) engine_.restore_unit(state.unit.get());
    rest_ = state.rest;
    behind_ = 0;
    tick_ignored_ = false;
    ticks_.forget();
    engine_moved_ = true;
    storing_ = stored_ = false;
    host_moved_ = true;
    resting_ = state.resting;
    host_settled_ = state.host_settled;
    engine_settled_ = state.engine_settled;
  }

  void reset(bool active) {
    catch_up();
    if constexpr (requires { host_.hresetn; })
      host_.hresetn = !active;
    else
      host_.rst_ni = !active;
    engine_.rst_ni = !active;
    ticks_.forget();
    resting_ = host_settled_ = engine_settled_ = false;
  }

 private:
  static constexpr std::uint64_t kForever = ~0ULL;

  // An engine that only counts shows the host side sample points, if that asks for them, and no
  // more.
  void engine_counted() { engine_moved_ = engine_moved_ || engine_.tick_req_i != 0; }

  // The engine's inputs as the host side has them now; true if any is new.
  bool show_engine() {
    if (!Ports::to_core(engine_, *host_.rootp)) return false;
    engine_disturbed_ = true;
    engine_moved_ = true;
    engine_.eval();
    return true;
  }

  // The host side's combinational logic has new inputs.
  void follow() {
    host_settled_ = host_moved_ = true;
    host_.eval();
    while (show_engine()) {
      ticks_.forget();
      if (!Ports::to_host(engine_, *host_.rootp)) return;
      host_.eval();
    }
  }

  // The edge before this one showed a sample point, and something else comes now.
  void see_tick() {
    ticks_.forget();
    ticks_.show(*host_.rootp);
    host_.eval();
    host_edge();
    resting_ = false;
  }

  // After an edge of the host side; before_ is what it was before, earlier_ one edge earlier, if
  // that was evaluated with the same inputs: a pass reads in every second clock.
  void begin_rest() {
    const Root &root = *host_.rootp;
    // Which processes have run is not what they have left.
    if constexpr (requires { root.__VnbaTriggered; })
      before_.root().__VnbaTriggered = root.__VnbaTriggered;
    ticks_.end(engine_, root);
    resting_ = ticks_.learned() || before_.matches(root);
    rest_ = kForever;
    if (resting_ || !passes_rest_) return;
    rest_ = in_a_row_ < 2 ? 0 : TransmitScan<Root>::clocks(earlier_, root);
    resting_ = rest_ > 0;
  }

  void settle_host() {
    if constexpr (requires { verican_settle(host_.rootp); }) verican_settle(host_.rootp);
  }

  auto &host_clock() {
    if constexpr (requires { host_.hclk; })
      return host_.hclk;
    else
      return host_.clk_i;
  }

  // A root holds plain bits, a pointer to its symbols and a name that never change.
  template <typename T>
  static std::unique_ptr<unsigned char[]> copy_of(const T &root) {
    auto bytes = std::make_unique<unsigned char[]>(sizeof(T));
    std::memcpy(bytes.get(), static_cast<const void *>(&root), sizeof(T));
    return bytes;
  }

  void host_edge() {
    if (host_settled_ && !kPlainEdges)
      settled_edge(host_);
    else
      rising_edge(host_, host_clock());
    host_settled_ = host_moved_ = true;
  }

  // Of the engine's inputs, can_rx_i alone changes without an eval(): only u_sync's first flip-flop
  // looks at it.
  void engine_edge() {
    if (engine_settled_ && !kPlainEdges)
      settled_edge(engine_);
    else
      rising_edge(engine_, engine_.clk_i);
    engine_settled_ = engine_moved_ = true;
  }

  SerialContext context_;
  Engine engine_{&context_, "engine"};
  HostModel host_{&context_, "host"};
  ModelContext model_context_{context_};
  HostImage<Root> before_, earlier_;
  unsigned in_a_row_ = 0;          // edges evaluated since anything else has happened
  std::uint64_t rest_ = kForever;  // while resting_: edges to come that may be left out
  std::uint64_t behind_ = 0;       // edges that have been
  ByteStore<Root, Ports> store_;
  bool storing_ = false;  // a byte in the clock before this one
  bool stored_ = false;   // one or more, and what is combinational has not followed
  bool passes_rest_ = true;
  bool bytes_rest_ = true;
  bool resting_ = false;
  bool host_settled_ = false;
  bool host_moved_ = true;
  bool engine_settled_ = false;
  bool engine_disturbed_ = false;
  mutable bool engine_moved_ = true;  // since nothing of it was to wake the host side
  bool tick_ignored_ = false;         // in the last edge
  TickRest<Root, Ports> ticks_;
};

}  // namespace vericansim
