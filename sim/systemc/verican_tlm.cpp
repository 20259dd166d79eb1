// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// VericanTlm: see verican_tlm.hpp. The socket's side is in verican_transport.cpp.
#include "systemc/verican_tlm.hpp"

#include "systemc/can_bus.hpp"

namespace vericansim {

VericanTlm::VericanTlm(const sc_core::sc_module_name &name, const TlmConfig &config)
    : sc_core::sc_module{name},
      config_{config},
      node_{RtlNode::create(std::string{name}, config.clock, config.num_mb)} {
  check_time_resolution();
  socket.register_b_transport(this, &VericanTlm::b_transport);
  socket.register_transport_dbg(this, &VericanTlm::transport_dbg);
  socket.register_get_direct_mem_ptr(this, &VericanTlm::get_direct_mem_ptr);
  SC_HAS_PROCESS(VericanTlm);
  SC_METHOD(on_can_rx);
  sensitive << can_rx;
  SC_METHOD(on_stop_req);
  sensitive << stop_req;
  SC_METHOD(on_reset);
  sensitive << rst_n;
  SC_METHOD(drive_outputs);
  sensitive << outputs_;
}

// ---- Elaboration

template <typename Port>
void VericanTlm::bind_if_open(Port &port, bool value) {
  if (port.bind_count() != 0) return;
  const std::string name = std::string{port.basename()} + "_open";
  open_ends_.push_back(std::make_unique<sc_core::sc_signal<bool>>(name.c_str(), value));
  port.bind(*open_ends_.back());
}

void VericanTlm::before_end_of_elaboration() {
  SC_HAS_PROCESS(VericanTlm);
  if (config_.timing == TlmTiming::kCycleExact) {
    if (clk.bind_count() != 0) {
      SC_METHOD(edge);
      sensitive << clk.pos();
      dont_initialize();
    } else {
      SC_METHOD(own_clock);
    }
  }
  bind_if_open(clk, false);
  bind_if_open(rst_n, true);
  bind_if_open(stop_req, false);
  if (config_.timing == TlmTiming::kLooselyTimed) {
    bind_if_open(can_rx, true);
    bind_if_open(can_tx, true);
  }
  for (auto *line :
       {&irq, &irq_mb, &irq_bus_off, &irq_error, &irq_tx_warning, &irq_rx_warning, &irq_wake}) {
    bind_if_open(*line, false);
  }
}

void VericanTlm::end_of_elaboration() {
  if (config_.timing == TlmTiming::kLooselyTimed && bus_ == nullptr) {
    SC_REPORT_FATAL(name(), "a loosely timed VericanTlm needs CanBus::attach()");
  }
}

// ---- Clock by clock

void VericanTlm::own_clock() {
  Clock &oscillator = node_->oscillator();
  if (oscillator.next() == to_ps(sc_core::sc_time_stamp())) {
    edge();
    oscillator.tick();
  }
  next_trigger(to_sc_time(oscillator.next()) - sc_core::sc_time_stamp());
}

void VericanTlm::edge() {
  if (!reset_n_.before() || !reset_n_.now()) return;
  if (stop_.before() != stop_given_) {
    stop_given_ = stop_.before();
    node_->request_stop(stop_given_);
  }
  take_requests();
  node_->clock(to_level(rx_.before()));
  finish_requests();
  outputs_changed(sc_core::SC_ZERO_TIME);
}

void VericanTlm::take_requests() {
  const sc_core::sc_time now = sc_core::sc_time_stamp();
  for (; taken_ < requests_.size() && requests_[taken_]->arrival < now; ++taken_)
    requests_[taken_]->first = submit(requests_[taken_]->transfers);
}

void VericanTlm::finish_requests() {
  bool any = false;
  while (taken_ != 0) {
    Request &oldest = *requests_.front();
    if (!node_->ahb().done(oldest.first + oldest.transfers.size() - 1)) break;
    oldest.done = any = true;
    requests_.pop_front();
    --taken_;
  }
  if (any) finished_.notify(sc_core::SC_ZERO_TIME);
}

// ---- Pins

void VericanTlm::on_stop_req() {
  stop_.update(stop_req.read());
  if (config_.timing != TlmTiming::kLooselyTimed) return;
  bus_->catch_up();
  node_->request_stop(stop_req.read());
}

// Both ends of the pulse reset the core: between them a loosely timed one goes on running, off the
// bus.
void VericanTlm::on_reset() {
  const bool before = reset_n_.now();
  reset_n_.update(rst_n.read());
  if (before == rst_n.read()) return;
  if (config_.timing == TlmTiming::kLooselyTimed) bus_->catch_up();
  reset();
}

void VericanTlm::reset() {
  node_->reset();
  for (const auto &request : requests_) request->aborted = true;
  requests_.clear();
  taken_ = 0;
  finished_.notify(sc_core::SC_ZERO_TIME);
  outputs_changed(sc_core::SC_ZERO_TIME);
}

// `delay`: how far the core is ahead of SystemC's time.
void VericanTlm::outputs_changed(const sc_core::sc_time &delay) {
  if (node_->irq_lines() == shown_irq_ && node_->tx() == shown_tx_) return;
  if (delay == sc_core::SC_ZERO_TIME) {
    outputs_.notify();
  } else {
    outputs_.notify(delay);
  }
}

void VericanTlm::drive_outputs() {
  shown_irq_ = node_->irq_lines();
  shown_tx_ = node_->tx();
  const auto line = [this](IrqLine which) { return (shown_irq_ & which) != 0; };
  can_tx.write(to_bool(shown_tx_));
  irq.write(line(kIrqAll));
  irq_mb.write(line(kIrqMb));
  irq_bus_off.write(line(kIrqBusOff));
  irq_error.write(line(kIrqError));
  irq_tx_warning.write(line(kIrqTxWarning));
  irq_rx_warning.write(line(kIrqRxWarning));
  irq_wake.write(line(kIrqWake));
}

}  // namespace vericansim
