// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RandomRemotes: a bus of remote nodes with a host that sends random commands.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/faults.hpp"
#include "node/core_node.hpp"
#include "remote/random_host.hpp"
#include "remote/remote_shadow.hpp"

namespace vericansim {

/// A clock with the bit timing of 1 Mbit/s, sample point at 75 %.
struct RemoteClock {
  double hz;
  BitTiming timing;
};
/// Clocks from 8 to 48 MHz.
const std::vector<RemoteClock> &remote_clocks();

/// Two to eight nodes, each with its own clock, delay and model beside it; noise in some seeds.
class RandomRemotes {
 public:
  RandomRemotes(const std::string &profile, unsigned seed);
  ~RandomRemotes();

  /// One command of the host, sometimes with a hold, an access of user logic or a disturbed bit;
  /// until nothing is under way. False: something differs, see difference().
  bool step();
  [[nodiscard]] const std::string &difference() const { return difference_; }
  [[nodiscard]] unsigned nodes() const { return static_cast<unsigned>(nodes_.size()); }
  [[nodiscard]] unsigned answers() const;
  [[nodiscard]] unsigned disturbed() const { return disturbed_; }
  /// The last commands, for a message.
  [[nodiscard]] std::string history() const;

 private:
  void add_node(const std::string &profile, unsigned number);
  void disturb();
  void user();
  bool settle();
  void compare();

  RandomHost dice_;
  std::vector<std::unique_ptr<RemoteNode>> nodes_;
  std::vector<std::unique_ptr<RemoteShadow>> shadows_;
  std::vector<std::unique_ptr<Fault>> faults_;
  std::unique_ptr<CoreNode> host_;
  Bus bus_;
  ScheduledFaults flips_;
  std::string difference_;
  std::vector<std::string> steps_;
  unsigned count_ = 0;
  unsigned disturbed_ = 0;
};

}  // namespace vericansim
