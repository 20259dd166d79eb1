// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FlopRemote: see flop_remote.hpp. The flip-flops are members of the model's root (flops.inc).
#include "softerror/remote/flop_remote.hpp"

#include <algorithm>
#include <cstddef>

#include "Vcan_remote_flops.h"
#include "Vcan_remote_flops___024root.h"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"

// Verilator's own (5.006): evaluates all logic that is not clocked.
void Vcan_remote_flops___024root___eval_settle(Vcan_remote_flops___024root *root);

namespace vericansim {
namespace {

using Root = Vcan_remote_flops___024root;

const FlopPlaces &places() {
  static const auto list = [] {
    FlopPlaces all;
#define FLOP(name, member, mask) all.add(name, offsetof(Root, member), mask);
#include "flops.inc"
#undef FLOP
    return all;
  }();
  return list;
}

}  // namespace

struct FlopRemote::Impl {
  SerialContext context;
  Vcan_remote_flops top{&context, "can_remote"};
  ModelContext model_context{context};

  void flip(unsigned flop) {
    places().flip(top.rootp, flop);
    Vcan_remote_flops___024root___eval_settle(top.rootp);
  }
  [[nodiscard]] bool value(unsigned flop) { return places().value(top.rootp, flop); }
};

const FlopPlaces &FlopRemote::flops() { return places(); }

FlopRemote::FlopRemote(const ClockConfig &clock, const FlopFlip &flip)
    : Node{"flipped", clock}, impl_{std::make_unique<Impl>()}, flip_{flip} {
  impl_->top.node_i = 3;
  impl_->top.can_rx_i = 1;
  reset();
}

FlopRemote::~FlopRemote() = default;

void FlopRemote::reset() {
  impl_->top.rst_ni = 0;
  impl_->top.start_i = 0;
  for (int i = 0; i < 4; ++i) edge();
  impl_->top.rst_ni = 1;
  run_ = 0;
}

void FlopRemote::edge() {
  rising_edge(impl_->top, impl_->top.clk_i);
  const bool now = flip_.stuck ? clocks_ >= flip_.clock && impl_->value(flip_.flop) != *flip_.stuck
                               : clocks_ == flip_.clock;
  ++clocks_;
  if (now) impl_->flip(flip_.flop);
}

void FlopRemote::clock(Level rx) {
  auto &top = impl_->top;
  top.can_rx_i = static_cast<std::uint8_t>(rx);
  if (top.usr_ready_o) top.start_i = 1;
  edge();
  drive(static_cast<Level>(top.can_tx_o));
  run_ = top.can_tx_o ? 0 : run_ + 1;
  longest_run_ = std::max(longest_run_, run_);
}

std::uint64_t FlopRemote::trace() const { return impl_->top.trace_o; }

}  // namespace vericansim
