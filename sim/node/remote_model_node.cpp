// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteModelNode: see remote_model_node.hpp.
#include "node/remote_model_node.hpp"

#include <cmath>
#include <utility>

namespace vericansim {
namespace {

constexpr unsigned kHoldClocks = 64;  // RN-52

CoreConfig engine_config(const BitTiming &timing) {
  CoreConfig config;
  config.timing = timing;
  config.boff_rec = true;  // the model says when (RN-72)
  return config;
}

}  // namespace

RemoteModelNode::RemoteModelNode(std::string name, const RemoteConfig &config, unsigned number,
                                 const BitTiming &timing, const ClockConfig &clock)
    : RemoteUnit{std::move(name), clock},
      model_{config, number},
      core_{this->name(), engine_config(timing), clock},
      core_config_{engine_config(timing)},
      clocks_per_ms_{static_cast<std::uint64_t>(std::llround(clock.frequency_hz / 1000))},
      to_tick_{clocks_per_ms_} {}

void RemoteModelNode::start() {
  model_.start();
  core_.start();
  present();
}

std::uint8_t RemoteModelNode::peek(unsigned address) const { return model_.memory()[address]; }

bool RemoteModelNode::idle() const {
  const bool off = model_.state() == RemoteState::kInit;
  return off || (core_.idle() && !under_way_ && !model_.wants() && !model_.restarting());
}

void RemoteModelNode::user_write(unsigned index, std::uint32_t data, unsigned lanes) {
  model_.user_write(index, data, lanes);
  present();
}

void RemoteModelNode::hold(bool on) {
  held_ = on;
  held_for_ = 0;
  model_.hold(on);
  present();
}

void RemoteModelNode::event(unsigned k) {
  model_.event(k);
  present();
}

void RemoteModelNode::clock(Level rx) {
  count_edges(1);
  core_.clock(rx);
  drive(core_.tx());
  if (std::exchange(shows_, false)) show_pulses();
  const std::uint64_t word = core_.trace();
  if ((word & (kTraceEvents | kTraceSample)) != 0) follow(decode_trace(word));
  if (model_.restarting() && !core_.running()) restart();
  if (held_for_ != 0 && ++held_for_ > kHoldClocks) expire_hold();
  if (--to_tick_ != 0) return;
  to_tick_ = clocks_per_ms_;
  model_.tick();
  if (off_bus_ && model_.may_recover() && core_.config().boff_rec) {
    CoreConfig config = core_config_;
    config.boff_rec = false;
    core_.configure(config);
  }
  present();
}

void RemoteModelNode::expire_hold() {
  held_for_ = 0;
  model_.hold_expired();
  shows_ = true;
  present();
}

void RemoteModelNode::follow(const Trace &trace) {
  follow_sending(trace);
  follow_errors(trace);
  if (trace.rx_valid && !core_.received().empty()) {
    model_.receive(core_.received().back());
    held_for_ = held_ ? 1 : 0;
    present();
  }
  core_.received().clear();
  core_.sent().clear();
  if (trace.sample) follow_sample(trace);
}

void RemoteModelNode::follow_sending(const Trace &trace) {
  if (trace.start && trace.transmitter) {
    under_way_ = true;
    model_.attempt();
  }
  if (!under_way_ || !(trace.tx_ok || trace.tx_fail)) return;
  under_way_ = false;
  if (trace.tx_ok) {
    presented_.reset();
    model_.sent();
  } else if (trace.errors != 0) {
    model_.failed();
  } else {
    model_.lost_arbitration();
  }
  present();
}

void RemoteModelNode::follow_errors(const Trace &trace) {
  if (!trace.bus_off) model_.set_errors(trace.tec, trace.rec);
  if (trace.bus_off == off_bus_) return;
  off_bus_ = trace.bus_off;
  if (off_bus_) {
    model_.went_bus_off();
  } else {
    core_.configure(core_config_);
    model_.recovered();
  }
  present();
}

// The trace shows the place of the bit that is being sampled: this edge is not yet its sample
// point.
void RemoteModelNode::follow_sample(const Trace &trace) {
  constexpr std::uint8_t kInt2 = 1;  // bits of the intermission that follow
  if (trace.field == Field::kInt && trace.left == kInt2) {
    model_.intermission();
    shows_ = true;
  }
  if (model_.restarting() && trace.field == Field::kInt) core_.stop();
}

void RemoteModelNode::show_pulses() {
  for (const RemotePulse &pulse : model_.take_pulses())
    if (on_pulse) on_pulse(pulse);
}

// RN-60: the engine has stopped between two frames; it integrates anew.
void RemoteModelNode::restart() {
  core_.cancel();
  presented_.reset();
  model_.stopped();
  core_.start();
  present();
}

// Gives the engine the frame that the model wants to send, unless one is under way.
void RemoteModelNode::present() {
  const bool begins = trace_field(core_.trace()) == Field::kSof;
  if (under_way_ || begins) return;
  const std::optional<Frame> wanted = model_.wants();
  if (wanted == presented_) return;
  if (presented_) core_.cancel();
  presented_ = wanted;
  if (wanted) core_.request(*wanted);
}

}  // namespace vericansim
