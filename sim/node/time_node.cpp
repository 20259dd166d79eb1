// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimeNode: see time_node.hpp.
#include "node/time_node.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "Vcan_ahb_time.h"
#include "Vcan_ahb_time___024root.h"
#include "bus/trace.hpp"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/model_pins.hpp"
#include "node/time_flops.hpp"

namespace vericansim {
namespace {

// The clock in the model's root, if Verilator (5.006) left its members there.
#define VERICAN_FLOPS(root)                                                              \
  VERICAN_TIME_FLOPS(root, can_ahb__DOT__u_top__DOT__u_core__DOT__gen_time__DOT__u_time, \
                     can_ahb__DOT__u_top__DOT__time_left)

template <typename Root>
constexpr bool kKnown = !kPlainEdges && requires(Root & root) {
  VERICAN_FLOPS(root);
};

// Clocks for which a model that only counts has nothing to do.
template <typename Root>
std::uint64_t quiet_clocks(Root &root, std::uint64_t before_waiter) {
  if constexpr (kKnown<Root>) {
    const TimeFlops flops = VERICAN_FLOPS(root);
    return flops.held != 0 ? 0 : std::min(flops.clocks_before_compare(), before_waiter);
  } else {
    return 0;
  }
}

// Takes TIME so many clocks further that kFollow are left to be made; the clocks taken.
template <typename Root>
std::uint64_t leap_time(Root &root, std::uint64_t clocks) {
  if constexpr (kKnown<Root>) {
    if (clocks > TimeFlops::kFollow) {
      VERICAN_FLOPS(root).leap(clocks - TimeFlops::kFollow);
      return clocks - TimeFlops::kFollow;
    }
  }
  return 0;
}

// Nothing but TIME is different; `before` is spoilt.
template <typename Root>
bool only_time_moved(Root &before, Root &now) {
  VERICAN_FLOPS(before).copy_moving(VERICAN_FLOPS(now));
  return std::memcmp(static_cast<const void *>(&before), static_cast<const void *>(&now),
                     sizeof(Root)) == 0;
}

}  // namespace

struct TimeNode::Impl {
  using Root = Vcan_ahb_time___024root;

  ~Impl() { Verilated::threadContextp(&context); }

  SerialContext context;
  Vcan_ahb_time top{&context, "time"};
  ModelContext model_context{context};
  std::unique_ptr<unsigned char[]> before = std::make_unique<unsigned char[]>(sizeof(Root));
};

TimeNode::TimeNode(std::string name, const ClockConfig &clock)
    : RtlNode{std::move(name), clock, 64}, impl_{std::make_unique<Impl>()} {
  reset();
}

TimeNode::~TimeNode() = default;

void TimeNode::edge() {
  Vcan_ahb_time &top = impl_->top;
  rising_edge(top, top.hclk);
  if (top.hresetn == 0) return;
  ++edges_;
  const bool dominant = (top.trace_o & kTraceTx) == 0;
  if (dominant && !dominant_) falls_.push_back(edges_);
  dominant_ = dominant;
  if (decode_trace(top.trace_o).rx_valid) valids_.push_back(edges_);
  if ((top.time_out_o != 0) != out_) pulses_.push_back(edges_);
  out_ = top.time_out_o != 0;
}

void TimeNode::reset() {
  disturbed();
  still_ = false;
  Vcan_ahb_time &top = impl_->top;
  ahb().reset();
  show_request(top, ahb().request());
  top.hready = 1;
  top.can_rx_i = 1;
  top.hresetn = 0;
  for (int i = 0; i < 4; ++i) edge();
  edges_ = 0;
  top.hresetn = 1;
  edge();
  drive(static_cast<Level>(top.can_tx_o));
}

void TimeNode::clock(Level rx) {
  Vcan_ahb_time &top = impl_->top;
  top.can_rx_i = static_cast<std::uint8_t>(rx);
  if (ahb().active()) {
    still_ = false;
    show_request(top, ahb().request());
    top.hready = top.hreadyout;
    top.eval();
    if (top.hready != top.hreadyout) {
      top.hready = top.hreadyout;
      top.eval();
    }
    const AhbResponse response{top.hrdata, top.hreadyout != 0, top.hresp != 0};
    edge();
    ahb().clock(response);
    if (!ahb().active()) {
      show_request(top, ahb().request());
      top.hready = 1;
    }
  } else if (rests_ && !decode_trace(top.trace_o).running) {
    watch_rest();
  } else {
    still_ = false;
    edge();
  }
  drive(static_cast<Level>(top.can_tx_o));
  after_edge();
  note_interrupt();
}

// ---- Rest

void TimeNode::watch_rest() {
  auto &root = *impl_->top.rootp;
  if constexpr (kKnown<Impl::Root>) {
    std::memcpy(impl_->before.get(), static_cast<const void *>(&root), sizeof root);
    edge();
    still_ = only_time_moved(*reinterpret_cast<Impl::Root *>(impl_->before.get()), root);
  } else {
    edge();
  }
}

std::uint64_t TimeNode::quiet() const {
  if (!still_ || ahb().active()) return 0;
  return quiet_clocks(*impl_->top.rootp, edges_to_waiter());
}

void TimeNode::pass(std::uint64_t edges) {
  passed(edges);
  const std::uint64_t leap = leap_time(*impl_->top.rootp, edges);
  edges_ += leap;
  edges -= leap;
  for (; edges > 0; --edges) edge();
}

void TimeNode::let_rest(bool allowed) {
  disturbed();
  rests_ = allowed;
  still_ = false;
}

// ---- Pins

std::uint64_t TimeNode::edges() const {
  catch_up();
  return edges_;
}

std::uint64_t TimeNode::trace() const { return impl_->top.trace_o; }
std::uint8_t TimeNode::irq_lines() const { return model_irq_lines(impl_->top); }
bool TimeNode::irq_time() const { return impl_->top.irq_time_o != 0; }

void TimeNode::note_interrupt() {
  const bool high = irq() || irq_time();
  if (high && !std::exchange(interrupt_, high) && on_interrupt) on_interrupt();
  interrupt_ = high;
}

void TimeNode::external(bool level) {
  disturbed();
  still_ = false;
  impl_->top.ext_i = level;
}

void TimeNode::request_stop(bool stop) {
  disturbed();
  still_ = false;
  impl_->top.stop_req_i = stop;
}

AhbResult TimeNode::peek(const AhbTransfer & /*transfer*/) {
  throw std::logic_error("a TimeNode is read by real transfers only");
}

}  // namespace vericansim
