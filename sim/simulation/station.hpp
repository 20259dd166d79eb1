// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Station: a Verilated core with its software, as the simulations of the tool put it on a bus.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "node/host.hpp"
#include "node/remote_unit.hpp"
#include "scenario/node_role.hpp"

namespace vericansim {

/// Core, software, and what the software has received; or a node without a processor.
struct Station {
  std::unique_ptr<RtlNode> node;       ///< none: a remote node
  std::unique_ptr<RemoteUnit> remote;  ///< none: a core
  bool remote_is_rtl = false;          ///< else the model of its rules
  std::unique_ptr<Host> host;          ///< none: somebody else drives the core
  BitTiming timing;
  std::vector<Frame> received;
};

/// Creates core and software. Without filters every free buffer takes any frame. Throws as Host's
/// constructor.
[[nodiscard]] std::unique_ptr<Station> make_station(const std::string &name,
                                                    const ClockConfig &clock, HostConfig config,
                                                    unsigned num_mb = 64);

/// Creates a core alone. `timing`: what it is expected to be set to; throws as
/// BitTiming::validate().
[[nodiscard]] std::unique_ptr<Station> make_bare_station(const std::string &name,
                                                         const ClockConfig &clock,
                                                         const BitTiming &timing,
                                                         unsigned num_mb = 64);

/// Creates a remote node with its first memory. Throws as RemoteModelNode's constructor.
[[nodiscard]] std::unique_ptr<Station> make_remote_station(const std::string &name,
                                                           const ClockConfig &clock,
                                                           const BitTiming &timing,
                                                           const RemoteRole &role);

/// The stations of one bus; they must outlive it.
class Stations {
 public:
  void add(Bus &bus, std::unique_ptr<Station> station, const Link &link);
  [[nodiscard]] Station &operator[](NodeId id) { return *stations_[id]; }
  [[nodiscard]] const Station &operator[](NodeId id) const { return *stations_[id]; }
  [[nodiscard]] NodeId size() const { return static_cast<NodeId>(stations_.size()); }

  /// Sets all nodes with software up and lets them integrate: runs `bus` until then. `bit_time` in
  /// ps. Throws std::runtime_error if a node's set-up fails or takes longer than 100 ms.
  void join(Bus &bus, Time bit_time);
  /// Lets the remote nodes join.
  void start_remote_nodes();
  /// Whether the cores store remote frames in receive buffers; valid after join().
  [[nodiscard]] bool stores_remote() const { return stores_remote_; }
  /// Rethrows what went wrong in a node's software.
  void check();
  /// Frames that have been queued and have not left.
  [[nodiscard]] std::uint64_t pending() const;
  /// Clock cycles of all nodes so far.
  [[nodiscard]] std::uint64_t cycles() const;

 private:
  std::vector<std::unique_ptr<Station>> stations_;
  bool stores_remote_ = false;
};

}  // namespace vericansim
