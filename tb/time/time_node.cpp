// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See time_node.hpp.
#include "time/time_node.hpp"

#include <stdexcept>
#include <utility>

#include "bus/trace.hpp"
#include "node/model_pins.hpp"

namespace vericansim {

TimeNode::TimeNode(std::string name, const ClockConfig &clock)
    : RtlNode{std::move(name), clock, 64} {
  reset();
}

TimeNode::~TimeNode() { Verilated::threadContextp(&context_); }

void TimeNode::edge() {
  top_.hclk = 0;
  top_.eval();
  top_.hclk = 1;
  top_.eval();
  if (top_.hresetn == 0) return;
  ++edges_;
  const bool dominant = (top_.trace_o & kTraceTx) == 0;
  if (dominant && !dominant_) falls_.push_back(edges_);
  dominant_ = dominant;
  if (decode_trace(top_.trace_o).rx_valid) valids_.push_back(edges_);
  if ((top_.time_out_o != 0) != out_) pulses_.push_back(edges_);
  out_ = top_.time_out_o != 0;
}

void TimeNode::reset() {
  ahb().reset();
  show_request(top_, ahb().request());
  top_.hready = 1;
  top_.can_rx_i = 1;
  top_.hresetn = 0;
  for (int i = 0; i < 4; ++i) edge();
  edges_ = 0;
  top_.hresetn = 1;
  edge();
  drive(static_cast<Level>(top_.can_tx_o));
}

void TimeNode::clock(Level rx) {
  top_.can_rx_i = static_cast<std::uint8_t>(rx);
  if (ahb().active()) {
    show_request(top_, ahb().request());
    top_.hready = top_.hreadyout;
    top_.eval();
    if (top_.hready != top_.hreadyout) {
      top_.hready = top_.hreadyout;
      top_.eval();
    }
    const AhbResponse response{top_.hrdata, top_.hreadyout != 0, top_.hresp != 0};
    edge();
    ahb().clock(response);
    if (!ahb().active()) {
      show_request(top_, ahb().request());
      top_.hready = 1;
    }
  } else {
    edge();
  }
  drive(static_cast<Level>(top_.can_tx_o));
  after_edge();
}

std::uint64_t TimeNode::trace() const { return top_.trace_o; }
std::uint8_t TimeNode::irq_lines() const { return model_irq_lines(top_); }
void TimeNode::request_stop(bool stop) { top_.stop_req_i = stop; }
AhbResult TimeNode::peek(const AhbTransfer & /*transfer*/) {
  throw std::logic_error("a TimeNode is read by real transfers only");
}

std::vector<std::unique_ptr<RtlNode>> TimeRig::make(const std::vector<Time> &first_edges,
                                                    std::vector<TimeNode *> &made) {
  std::vector<std::unique_ptr<RtlNode>> all;
  for (const Time phase : first_edges) {
    auto node = std::make_unique<TimeNode>("node" + std::to_string(made.size()),
                                           ClockConfig{.phase = phase});
    made.push_back(node.get());
    all.push_back(std::move(node));
  }
  return all;
}

TimeRig::TimeRig(const std::vector<Time> &first_edges)
    : phases{first_edges}, rig{make(phases, nodes)} {}

std::uint64_t TimeRig::time(unsigned n) {
  const std::uint64_t low = rig.read(n, time_reg::kTimelo);
  return low | (std::uint64_t{rig.read(n, time_reg::kTimehi)} << 32);
}

std::uint64_t TimeRig::stamp(unsigned n, unsigned mb) {
  const std::uint64_t low = rig.read(n, time_reg::stamp(mb));
  return low | (std::uint64_t{rig.read(n, time_reg::stamp(mb) + 4)} << 32);
}

}  // namespace vericansim
