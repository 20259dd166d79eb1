// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PortOperator, MonitorOperator: see port_operator.hpp.
#include "port_operator.hpp"

#include "frame_form.hpp"
#include "simulation/node_timing.hpp"
#include "simulation/simulation.hpp"

namespace vericansim {

PortOperator::PortOperator(const OperatorContext &context, std::shared_ptr<CanPort> port,
                           const PortOptions &options, bool ends_when_down)
    : PortOutlet{std::move(port), ends_when_down},
      id_{context.id},
      node_{PortOutlet::port(), context.simulation().node(context.id),
            timing_of(context.scenario(), context.spec(), context.simulation().bitrate()),
            options} {}

void PortOperator::report(RunReport &report) {
  const std::size_t left = port().remaining();
  PortCounts counts = node_.counts();
  counts.from_host += left;
  report.nodes[id_].overruns = counts.overruns;
  report.ports.push_back({name(), false, up(), node_.bus_off(), counts, port().lost(),
                          node_.pending() + left, node_.waiting()});
}

void MonitorOperator::on_frame(const BusFrame &frame) {
  ++counts_.received;
  box_.push({.frame = to_can_frame(frame.frame), .time = frame.end});
}

void MonitorOperator::on_event(const BusEvent &event) {
  if (errors_ == ErrorChoice::kOwn)
    if (const auto message = bus_error_message(event))
      box_.push({.frame = *message, .time = event.end});
}

void MonitorOperator::report(RunReport &report) {
  report.ports.push_back({name(), true, up(), false, counts_, port().lost(), 0, box_.size()});
}

}  // namespace vericansim
