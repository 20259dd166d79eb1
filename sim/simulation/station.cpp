// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Stations: set-up and questions to all of them.
#include "simulation/station.hpp"

#include <algorithm>
#include <stdexcept>

#include "bus/range.hpp"
#include "model/registers.hpp"
#include "node/remote_model_node.hpp"
#include "node/remote_node.hpp"

namespace vericansim {
namespace {

/// Buffers that take any frame: base and extended ones in turn, since IDE is compared unless
/// CTRL2.EACEN is set.
std::vector<RxFilter> any_frame(unsigned buffers) {
  std::vector<RxFilter> filters(buffers);
  for (unsigned i = 1; i < buffers; i += 2) filters[i].extended = true;
  return filters;
}

}  // namespace

std::unique_ptr<Station> make_station(const std::string &name, const ClockConfig &clock,
                                      HostConfig config, unsigned num_mb) {
  require_range("transmit buffers", config.tx_buffers, 1, num_mb - 1);
  if (config.filters.empty()) config.filters = any_frame(num_mb - config.tx_buffers);
  auto station = std::make_unique<Station>();
  station->timing = config.timing;
  station->node = RtlNode::create(name, clock, num_mb);
  station->host = std::make_unique<Host>(*station->node, config);
  station->host->on_received = [target = station.get()](const HostFrame &frame) {
    target->received.push_back(frame.frame);
  };
  return station;
}

std::unique_ptr<Station> make_bare_station(const std::string &name, const ClockConfig &clock,
                                           const BitTiming &timing, unsigned num_mb) {
  timing.validate();
  auto station = std::make_unique<Station>();
  station->timing = timing;
  station->node = RtlNode::create(name, clock, num_mb);
  return station;
}

std::unique_ptr<Station> make_remote_station(const std::string &name, const ClockConfig &clock,
                                             const BitTiming &timing, const RemoteRole &role) {
  auto station = std::make_unique<Station>();
  station->timing = timing;
  const bool rtl = role.body == RemoteRole::Body::kRtl ||
                   (role.body == RemoteRole::Body::kBest && RemoteNode::has(role.config));
  station->remote_is_rtl = rtl;
  if (rtl)
    station->remote = RemoteNode::create(name, role.config, role.number, timing, clock);
  else
    station->remote =
        std::make_unique<RemoteModelNode>(name, role.config, role.number, timing, clock);
  for (const auto &[first, bytes] : role.memory) {
    unsigned address = first;
    for (const std::uint8_t byte : bytes) {
      const unsigned lane = address % 4;
      station->remote->user_write(address / 4, std::uint32_t{byte} << (8 * lane), 1U << lane);
      ++address;
    }
  }
  return station;
}

void Stations::add(Bus &bus, std::unique_ptr<Station> station, const Link &link) {
  if (station->remote)
    bus.add(*station->remote, link);
  else
    bus.add(*station->node, link);
  stations_.push_back(std::move(station));
}

void Stations::join(Bus &bus, Time bit_time) {
  constexpr Time kLimit = 100 * kMillisecond;
  constexpr Time kIntegration = 14;  // bits; 11 are needed (IN-01)
  for (const auto &station : stations_)
    if (station->host) station->host->start();
  const auto all_ready = [&] {
    return std::all_of(stations_.begin(), stations_.end(),
                       [](const auto &s) { return !s->host || s->host->ready(); });
  };
  const bool ready = bus.run_until(all_ready, kLimit);
  check();
  if (!ready) throw std::runtime_error("the set-up of a node takes longer than 100 ms");
  const auto first = std::find_if(stations_.begin(), stations_.end(),
                                  [](const auto &s) { return s->host != nullptr; });
  if (first != stations_.end())
    stores_remote_ = ((*first)->node->read32(reg::kCtrl2) & reg::kCtrl2Rrs) != 0;
  bus.run_for(kIntegration * bit_time);
}

void Stations::start_remote_nodes() {
  for (const auto &station : stations_)
    if (station->remote) station->remote->start();
}

void Stations::check() {
  for (const auto &station : stations_)
    if (station->host) station->host->check();
}

std::uint64_t Stations::pending() const {
  std::uint64_t sum = 0;
  for (const auto &station : stations_)
    if (station->host) sum += station->host->pending();
  return sum;
}

std::uint64_t Stations::cycles() const {
  std::uint64_t sum = 0;
  for (const auto &station : stations_)
    sum += station->remote ? station->remote->clocked() : station->node->clocked();
  return sum;
}

}  // namespace vericansim
