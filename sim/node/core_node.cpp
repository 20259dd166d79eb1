// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CoreNode: see core_node.hpp; the word hand-shake follows the port comments of rtl/can_core.sv.
#include "node/core_node.hpp"

#include <stdexcept>
#include <utility>

#include "Vcan_core.h"
#include "Vcan_core___024root.h"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/quiet_engine.hpp"
#include "verilated.h"

namespace vericansim {

struct CoreNode::Impl {
  SerialContext context;
  Vcan_core top{&context, "can_core"};
  ModelContext model_context{context};
  QuietEngine quiet;
  void edge() { rising_edge(top, top.clk_i); }
};

CoreNode::CoreNode(std::string name, const CoreConfig &config, const ClockConfig &clock)
    : Node{std::move(name), clock}, impl_{std::make_unique<Impl>()} {
  configure(config);
  reset();
}

CoreNode::~CoreNode() { impl_->top.final(); }

// An input is about to change.
void CoreNode::input_changes() {
  disturbed();
  impl_->quiet.disturbed();
}

void CoreNode::configure(const CoreConfig &config) {
  config.timing.validate();
  input_changes();
  config_ = config;
  auto &top = impl_->top;
  top.presdiv_i = config.timing.prescaler - 1;
  top.propseg_i = config.timing.prop - 1;
  top.pseg1_i = config.timing.ps1 - 1;
  top.pseg2_i = config.timing.ps2 - 1;
  top.rjw_i = config.timing.sjw - 1;
  top.smp_i = config.triple_sampling;
  top.lom_i = config.listen_only;
  top.lpb_i = config.loop_back;
  top.fd_tolerant_i = config.fd_tolerant;
  top.boff_rec_i = config.boff_rec;
}

void CoreNode::reset() {
  input_changes();
  auto &top = impl_->top;
  requests_.clear();
  on_wire_ = false;
  word_ = 0;
  top.run_i = 0;
  top.tx_req_i = 0;
  top.ec_we_i = 0;
  top.ec_clear_i = 0;
  top.can_rx_i = 1;
  top.rst_ni = 0;
  for (int i = 0; i < 4; ++i) impl_->edge();
  top.rst_ni = 1;
  for (int i = 0; i < 4; ++i) impl_->edge();
  drive(static_cast<Level>(top.can_tx_o));
}

// A frame that was under way at the stop begins anew: its ID word is due.
void CoreNode::start() {
  input_changes();
  on_wire_ = false;
  word_ = 0;
  present();
  impl_->top.run_i = 1;
}
void CoreNode::stop() {
  input_changes();
  impl_->top.run_i = 0;
}
bool CoreNode::running() const { return impl_->top.running_o; }
bool CoreNode::idle() const { return impl_->top.running_o && impl_->top.idle_o; }
bool CoreNode::integrated() const { return impl_->top.synch_o; }
bool CoreNode::bus_off() const { return impl_->top.boff_o; }
bool CoreNode::passive() const { return impl_->top.passive_o; }
std::uint64_t CoreNode::trace() const {
  catch_up();
  return impl_->top.trace_o;
}

void CoreNode::preset_counters(std::uint8_t tec, std::uint8_t rec) {
  auto &top = impl_->top;
  if (top.run_i || top.running_o)
    throw std::logic_error("counters can only be preset while stopped");
  input_changes();
  top.ec_wdata_i = static_cast<std::uint16_t>((rec << 8) | tec);
  top.ec_we_i = 1;
  impl_->edge();
  top.ec_we_i = 0;
  impl_->edge();
}

void CoreNode::request(const Frame &frame, bool one_shot) {
  frame.validate();
  requests_.push_back({frame, one_shot, false});
  if (requests_.size() == 1) present();
}

void CoreNode::cancel() {
  if (on_wire_) {
    requests_.resize(1);
    requests_.front().cancelled = true;
  } else {
    requests_.clear();
  }
  present();
}

// Shows the front request, and the word of it that is due, at the inputs.
void CoreNode::present() {
  input_changes();
  auto &top = impl_->top;
  top.tx_req_i = !requests_.empty() && !requests_.front().cancelled;
  if (requests_.empty()) return;
  const Frame &frame = requests_.front().frame;
  top.tx_ide_i = frame.extended;
  top.tx_rtr_i = frame.remote;
  top.tx_dlc_i = frame.dlc;
  if (word_ == 0) {
    top.tx_word_i = frame.extended ? frame.id : frame.id << 18;
  } else {
    top.tx_word_i = frame.data_word(word_ == 1 ? 0 : 4);
  }
}

void CoreNode::finish_request(bool success) {
  const bool drop = success || requests_.front().one_shot || requests_.front().cancelled;
  if (success) sent_.push_back(requests_.front().frame);
  if (drop) requests_.pop_front();
  on_wire_ = false;
  word_ = 0;
  present();
}

void CoreNode::clock(Level rx) {
  auto &top = impl_->top;
  top.can_rx_i = static_cast<std::uint8_t>(rx);
  impl_->edge();
  impl_->quiet.clocked(top);
  drive(static_cast<Level>(top.can_tx_o));
  if ((top.trace_o & kTraceEvents) | top.tx_next_o | top.rx_hdr_o | top.rx_byte_we_o) collect();
}

std::uint64_t CoreNode::quiet() const { return impl_->quiet.edges(impl_->top, watched()); }
void CoreNode::pass(std::uint64_t edges) { impl_->quiet.pass(impl_->top, edges); }

void CoreNode::clock_lightly(Level rx) {
  if (!impl_->quiet.counts(impl_->top)) return clock(rx);
  impl_->quiet.clock_lightly(impl_->top, rx);
}

void CoreNode::collect() {
  auto &top = impl_->top;
  events_.errors |= top.err_o;
  if (top.start_o) {
    ++events_.started;
    on_wire_ = top.transmitter_o;
  }
  receiving_.clocked(top);
  if (top.rx_valid_o) {
    if (!top.transmitter_o) ++events_.delivered;
    if (!top.transmitter_o || config_.loop_back) received_.push_back(receiving_.frame());
  }
  if (top.tx_next_o) {
    on_wire_ = true;
    if (word_ < 2) ++word_;
    present();
  }
  if (top.tx_ok_o) ++events_.sent;
  if (top.tx_fail_o) ++events_.failed;
  if ((top.tx_ok_o || top.tx_fail_o) && !requests_.empty()) finish_request(top.tx_ok_o);
}

}  // namespace vericansim
