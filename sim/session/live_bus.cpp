// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// LiveBus: see live_bus.hpp.
#include "session/live_bus.hpp"

#include <stdexcept>

namespace vericansim {
namespace {

double chosen(double bitrate, const Scenario &scenario) {
  if (bitrate != 0) return bitrate;
  if (scenario.bitrates.empty())
    throw std::invalid_argument("neither the session nor the scenario has a bit rate");
  return scenario.bitrates.front();
}

}  // namespace

LiveBus::LiveBus(SessionBus bus)
    : scenario_{std::move(bus.scenario)},
      simulation_{scenario_, chosen(bus.bitrate, scenario_)},
      by_node_(scenario_.nodes.size()),
      want_bits_(scenario_.nodes.size()) {
  simulation_.on_bus_frame = [this](const BusFrame &frame) {
    for (Operator *op : all_) op->on_frame(frame);
  };
  simulation_.on_bus_event = [this](const BusEvent &event) {
    for (Operator *op : all_) op->on_event(event);
  };
  simulation_.on_host_received = [this](NodeId node, const Frame &frame) {
    for (Operator *op : all_) op->on_received(node, frame);
  };
  simulation_.on_host_sent = [this](NodeId node) {
    if (by_node_[node] != nullptr) by_node_[node]->on_sent();
  };
}

LiveBus::~LiveBus() {
  if (observes_) simulation_.bus().remove(*this);
}

void LiveBus::add(NodeId id, Operator &op) {
  all_.push_back(&op);
  if (id == kAllNodes) return;
  by_node_[id] = &op;
  if (!op.wants_bits()) return;
  want_bits_[id] = &op;
  if (!observes_) simulation_.bus().add(*this);
  observes_ = true;
}

void LiveBus::on_bit(NodeId id, const BitRecord &bit) {
  if (want_bits_[id] != nullptr) want_bits_[id]->on_bit(bit);
}

}  // namespace vericansim
