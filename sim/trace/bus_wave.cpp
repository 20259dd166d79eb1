// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusWave: from bus events to waveform changes in the order of time.
#include "trace/bus_wave.hpp"

#include <fmt/format.h>

#include <limits>
#include <set>
#include <string_view>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

constexpr const char *kBusScope = "bus";

const char *role_text(const Trace &trace) {
  if (!trace.running) return "OFF";
  switch (trace.field) {
    case Field::kInteg: return "WAIT FOR BUS IDLE";
    case Field::kBusOff: return "BUS OFF RECOVERY";
    case Field::kIdle: return "IDLE";
    default: return trace.transmitter ? "TRANSMITTING" : "RECEIVING";
  }
}

const char *state_text(const Trace &trace) {
  if (trace.bus_off) return "BUS OFF";
  return trace.passive ? "ERROR PASSIVE" : "ERROR ACTIVE";
}

const char *error_text(std::uint8_t errors) {
  if ((errors & kErrForm) != 0) return "FORM ERROR";
  if ((errors & kErrBit1) != 0) return "BIT1 ERROR";
  if ((errors & kErrBit0) != 0) return "BIT0 ERROR";
  if ((errors & kErrCrc) != 0) return "CRC ERROR";
  if ((errors & kErrAck) != 0) return "ACK ERROR";
  return (errors & kErrStuff) != 0 ? "STUFF ERROR" : "-";
}

/// Field names are literals, hence end with a zero.
const char *field_text(Field field) { return field_name(field).data(); }

/// Module names of a waveform hold no blanks.
std::string scope_name(const std::string &name) {
  std::string scope = name.empty() ? "node" : name;
  for (char &c : scope)
    if (static_cast<unsigned char>(c) <= ' ' || c == '$' || c == '.') c = '_';
  return scope;
}

/// Modules of the nodes. Names that would become one, or that of the bus, get a number; those that
/// are modules' names as they are go first.
std::vector<std::string> scopes_of(const std::vector<std::string> &names) {
  std::vector<std::string> scopes(names.size());
  std::set<std::string> taken{kBusScope};
  for (std::size_t n = 0; n < names.size(); ++n)
    if (scope_name(names[n]) == names[n] && taken.insert(names[n]).second) scopes[n] = names[n];
  for (std::size_t n = 0; n < names.size(); ++n) {
    if (!scopes[n].empty()) continue;
    const std::string base = scope_name(names[n]);
    scopes[n] = base;
    for (unsigned k = 2; !taken.insert(scopes[n]).second; ++k)
      scopes[n] = fmt::format("{}_{}", base, k);
  }
  return scopes;
}

}  // namespace

BusWave::BusWave(const Bus &bus, std::unique_ptr<WaveSink> sink, Time bit_time)
    : sink_{std::move(sink)}, hold_{2 * bit_time} {
  can_ = sink_->add_wire(kBusScope, "can", 1);
  std::vector<std::string> names;
  for (NodeId id = 0; id < bus.size(); ++id)
    names.push_back(const_cast<Bus &>(bus).node(id).name());
  for (const std::string &scope : scopes_of(names)) declare(scope);
  sink_->start();
  sink_->set(bus.now(), can_, static_cast<std::uint64_t>(bus.level()));
  for (NodeSignals &node : nodes_) {
    put(bus.now(), node.tx, 1);
    put(bus.now(), node.rx, 1);
  }
}

void BusWave::declare(const std::string &scope) {
  NodeSignals signals{};
  signals.tx = sink_->add_wire(scope, "tx", 1);
  signals.rx = sink_->add_wire(scope, "rx", 1);
  signals.field = sink_->add_text(scope, "field");
  signals.error = sink_->add_text(scope, "error");
  signals.role = sink_->add_text(scope, "role");
  signals.state = sink_->add_text(scope, "state");
  signals.sampled = sink_->add_wire(scope, "sampled", 1);
  signals.stuff = sink_->add_wire(scope, "stuff", 1);
  signals.tec = sink_->add_wire(scope, "tec", 9);
  signals.rec = sink_->add_wire(scope, "rec", 8);
  nodes_.push_back(signals);
}

void BusWave::put(Time time, WaveSink::Signal signal, std::uint64_t value, const char *text) {
  changes_.push({time, order_++, signal, value, text});
}

void BusWave::put_text(Time time, WaveSink::Signal signal, const char *&last, const char *text) {
  if (last == text) return;
  last = text;
  put(time, signal, 0, text);
}

void BusWave::put_value(Time time, WaveSink::Signal signal, int &last, int value) {
  if (last == value) return;
  last = value;
  put(time, signal, static_cast<std::uint64_t>(value));
}

void BusWave::on_level(Time time, Level level) {
  put(time, can_, static_cast<std::uint64_t>(level));
}

void BusWave::on_node_tx(NodeId node, Time time, Level level) {
  put(time, nodes_[node].tx, static_cast<std::uint64_t>(level));
}

void BusWave::on_node_rx(NodeId node, Time time, Level level) {
  put(time, nodes_[node].rx, static_cast<std::uint64_t>(level));
}

void BusWave::on_bit(NodeId node, const BitRecord &bit) {
  NodeSignals &to = nodes_[node];
  put_text(to.bit_start, to.field, to.field_text, field_text(bit.at.field));
  put_text(to.bit_start, to.role, to.role_text, role_text(bit.at));
  put_value(to.bit_start, to.stuff, to.stuff_value, bit.at.stuff ? 1 : 0);
  put_value(bit.time, to.sampled, to.sampled_value, static_cast<int>(bit.at.rx));
  put_text(bit.time, to.error, to.error_text, error_text(bit.after.errors));
  put_text(bit.time, to.state, to.state_text, state_text(bit.after));
  put_value(bit.time, to.tec, to.tec_value, (bit.after.bus_off ? 256 : 0) + bit.after.tec);
  put_value(bit.time, to.rec, to.rec_value, bit.after.rec);
}

void BusWave::on_clock(NodeId node, Time time, std::uint64_t trace) {
  NodeSignals &to = nodes_[node];
  // A node that does not run has no boundaries; its first bit begins when it runs again.
  if (to.boundary || (trace & kTraceRunning) == 0) to.bit_start = time;
  to.boundary = (trace & kTraceBoundary) != 0;
  if (node == 0) drain(time - hold_);
}

void BusWave::drain(Time before) {
  while (!changes_.empty() && changes_.top().time < before) {
    const Change &change = changes_.top();
    if (change.text != nullptr)
      sink_->set(change.time, change.signal, std::string_view{change.text});
    else
      sink_->set(change.time, change.signal, change.value);
    changes_.pop();
  }
}

void BusWave::finish(Time time) {
  drain(std::numeric_limits<Time>::max());
  sink_->finish(time);
}

std::unique_ptr<WaveSink> open_wave(const std::string &path) {
  if (path.ends_with(".vcd")) return open_vcd(path);
  if (path.ends_with(".fst")) return open_fst(path);
  throw InputError(path, 0, "a waveform's name must end with .vcd or .fst");
}

}  // namespace vericansim
