// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Simulation: the judges beside the nodes (`judge: lockstep`).
#include <fmt/format.h>

#include <algorithm>

#include "simulation/simulation.hpp"

namespace vericansim {
namespace {

/// Whether the software of a node wants a frame: any filter accepts it as the buffers do.
bool wants(const std::vector<RxFilter> &filters, const Frame &frame) {
  return filters.empty() || std::any_of(filters.begin(), filters.end(), [&](const RxFilter &f) {
           // The Host sets CTRL2.EACEN: format and RTR count only if asked for, and the words of
           // the identifiers are compared (flexcan.md 3.5).
           if (f.match_format && f.extended != frame.extended) return false;
           if (f.match_remote && f.remote != frame.remote) return false;
           const std::uint32_t id = frame.extended ? frame.id : frame.id << 18;
           const std::uint32_t mask = f.extended ? f.mask : f.mask << 18;
           const std::uint32_t wanted = f.extended ? f.id : f.id << 18;
           const std::uint32_t compared = frame.extended ? 0x1FFFFFFF : 0x1FFC0000;
           return ((id ^ wanted) & mask & compared) == 0;
         });
}

/// A received frame replaces the identifier in its buffer (flexcan.md 3.5), so that a base frame in
/// a buffer that compares the last 18 bits changes what it takes from then on.
bool filters_stay(const std::vector<RxFilter> &filters) {
  return std::all_of(filters.begin(), filters.end(), [](const RxFilter &f) {
    return !f.extended || f.match_format || (f.mask & 0x3FFFF) == 0;
  });
}

}  // namespace

void Simulation::set_up_judge() {
  judge_ = std::make_unique<BusJudge>(bit_time_);
  for (NodeId id = 0; id < stations_.size(); ++id) {
    judge_->add(*stations_[id].node);
    if (stations_[id].host) judge_software(id);
  }
  bus_.add(*judge_);
}

// Software whose buffers somebody else reads, too, may miss a frame.
void Simulation::judge_software(NodeId id) {
  const bool alone = std::none_of(scenario_.accesses.begin(), scenario_.accesses.end(),
                                  [&](const AccessSpec &access) { return access.node == id; });
  const HostConfig &config = scenario_.nodes[id].host;
  if (!alone || config.self_reception || config.loop_back || !filters_stay(config.filters)) return;
  judge_->expect_software(id,
                          [&config](const Frame &frame) { return wants(config.filters, frame); });
  Host &host = *stations_[id].host;
  host.on_received = [this, id, then = std::move(host.on_received)](const HostFrame &frame) {
    judge_->software_received(id, frame.frame, frame.overrun);
    then(frame);
  };
}

// When and where the judges must expect errors.
void Simulation::add_disturbances() {
  constexpr Time kForEver = 1'000'000 * kSecond;
  for (const FaultSpec &fault : scenario_.faults) {
    Window window = fault.window;
    window.from += start_;
    window.to = window.to >= kForEver ? kForEver : window.to + start_;
    const bool one = fault.kind == FaultSpec::Kind::kLevel || fault.kind == FaultSpec::Kind::kNoise;
    if (fault.kind == FaultSpec::Kind::kPlace) window = {start_, kForEver};
    judge_->disturbances().add(one ? fault.node : kAllNodes, window);
  }
  const bool all = std::all_of(scenario_.nodes.begin(), scenario_.nodes.end(),
                               [](const NodeSpec &node) { return node.hosted(); });
  const auto talkers = std::count_if(
      scenario_.nodes.begin(), scenario_.nodes.end(),
      [](const NodeSpec &node) { return !node.host.listen_only && !node.host.loop_back; });
  if (all && talkers > 1) judge_->all_on_bus(start_);
}

void Simulation::add_judgement(RunReport &report) const {
  const JudgeCounts counts = judge_->counts();
  report.judged = counts;
  report.checks.push_back(
      {"lockstep", "no difference",
       fmt::format("{} node-bits, {} accesses, {} frames compared: {}", counts.node_bits,
                   counts.accesses, counts.wire.exchanges,
                   judge_->findings().empty() ? "no difference" : judge_->findings().front()),
       judge_->findings().empty()});
  for (std::size_t i = 1; i < judge_->findings().size(); ++i)
    report.checks.push_back({"lockstep", "no difference", judge_->findings()[i], false});
}

}  // namespace vericansim
