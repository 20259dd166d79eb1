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

#include "Vcan_core.h"
#include "Vcan_core___024root.h"
#include "core_ports.hpp"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "verilated.h"

namespace vericansim {

/// The engine (Vcan_core) and a top whose engine is hollow (HostModel, cmake/split_core.py),
/// clocked together; `Ports` knows where in the top the engine is. Registers and buffers are three
/// quarters of the work of a clock and idle in most of them: when a clock edge has left every bit
/// of the model as it was, no further edge can change anything until an input does, and the model
/// is not evaluated. The result is that of the whole core in every clock
/// (tb/system/bus_split_core_test.cpp).
template <typename HostModel, typename Ports = AhbPorts>
class SplitCore {
 public:
  using Root = std::remove_reference_t<decltype(*std::declval<HostModel &>().rootp)>;

  SplitCore() = default;
  // Verilator 5.006 removes a model's scopes from the context that was last in use on this thread,
  // which may be that of another node and gone.
  ~SplitCore() { Verilated::threadContextp(&context_); }
  SplitCore(const SplitCore &) = delete;
  SplitCore &operator=(const SplitCore &) = delete;

  /// Host side pins; after changing one of its inputs call settle() or touch().
  [[nodiscard]] HostModel &host() { return host_; }
  [[nodiscard]] const HostModel &host() const { return host_; }
  /// Engine: CAN pins and trace.
  [[nodiscard]] Vcan_core &engine() { return engine_; }
  [[nodiscard]] const Vcan_core &engine() const { return engine_; }

  /// The host side's inputs have changed.
  void touch() { resting_ = host_settled_ = false; }

  /// The host side rests: nothing in it moves until an input of it does.
  [[nodiscard]] bool resting() const { return resting_; }

  /// Lets combinational outputs follow the inputs, across both models.
  void settle() {
    resting_ = false;
    host_settled_ = true;
    Ports::to_host(engine_, *host_.rootp);
    host_.eval();
    while (Ports::to_core(engine_, *host_.rootp)) {
      engine_.eval();
      if (!Ports::to_host(engine_, *host_.rootp)) return;
      host_.eval();
    }
  }

  /// One rising edge of the clock.
  void edge() {
    const bool changed =
        resting_ ? Ports::wakes_host(engine_, *host_.rootp) : Ports::to_host(engine_, *host_.rootp);
    if (changed) settle();
    if (resting_) {
      engine_edge();
      return;
    }
    std::memcpy(before_.get(), static_cast<const void *>(host_.rootp), sizeof(Root));
    if (host_settled_ && !kPlainEdges)
      settled_edge(host_);
    else
      rising_edge(host_, host_clock());
    host_settled_ = true;
    resting_ =
        std::memcmp(before_.get(), static_cast<const void *>(host_.rootp), sizeof(Root)) == 0;
    engine_edge();
    if (Ports::to_core(engine_, *host_.rootp)) engine_.eval();
  }

  /// Everything that the two models remember.
  struct State {
    std::unique_ptr<unsigned char[]> engine, host;
    bool resting, host_settled, engine_settled;
  };
  [[nodiscard]] State save() const {
    return {copy_of(*engine_.rootp), copy_of(*host_.rootp), resting_, host_settled_,
            engine_settled_};
  }
  void restore(const State &state) {
    std::memcpy(static_cast<void *>(engine_.rootp), state.engine.get(), sizeof(*engine_.rootp));
    std::memcpy(static_cast<void *>(host_.rootp), state.host.get(), sizeof(Root));
    resting_ = state.resting;
    host_settled_ = state.host_settled;
    engine_settled_ = state.engine_settled;
  }

  void reset(bool active) {
    if constexpr (requires { host_.hresetn; })
      host_.hresetn = !active;
    else
      host_.rst_ni = !active;
    engine_.rst_ni = !active;
    resting_ = host_settled_ = engine_settled_ = false;
  }

 private:
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

  // Of the engine's inputs, can_rx_i alone changes without an eval(): only u_sync's first flip-flop
  // looks at it.
  void engine_edge() {
    if (engine_settled_ && !kPlainEdges)
      settled_edge(engine_);
    else
      rising_edge(engine_, engine_.clk_i);
    engine_settled_ = true;
  }

  VerilatedContext context_;
  Vcan_core engine_{&context_, "engine"};
  HostModel host_{&context_, "host"};
  ModelContext model_context_{context_};
  std::unique_ptr<unsigned char[]> before_ = std::make_unique<unsigned char[]>(sizeof(Root));
  bool resting_ = false;
  bool host_settled_ = false;
  bool engine_settled_ = false;
};

}  // namespace vericansim
