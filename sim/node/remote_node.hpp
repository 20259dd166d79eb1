// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteNode: a Verilated can_remote with its user port.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "node/bit_timing.hpp"
#include "node/remote_unit.hpp"
#include "node/user_access.hpp"

namespace vericansim {

/// The RTL of a node without a processor. Its milliseconds are counted here, by its own clock, so
/// that the clock may have any frequency.
class RemoteNode : public RemoteUnit {
 public:
  /// `config` must be a profile, but for NameBits, serial number and rate table; `number`: node_i.
  /// Throws std::invalid_argument otherwise, and as BitTiming::validate().
  static std::unique_ptr<RemoteNode> create(std::string name, const RemoteConfig &config,
                                            unsigned number, const BitTiming &timing,
                                            const ClockConfig &clock = {});
  /// True if there is a Verilated model of `config`.
  [[nodiscard]] static bool has(const RemoteConfig &config);
  /// The parameters of which there is one, for messages.
  [[nodiscard]] static std::string available();

  /// rate_i = F: start() looks for the bit rate first (RN-73), among `rates`, eight of them, the
  /// first first. Throws std::logic_error for a node without AutoRate.
  virtual void search(std::vector<BitTiming> rates) = 0;
  /// Row that is tried, or was right; 0 without search().
  [[nodiscard]] virtual unsigned rate_row() const = 0;

  /// Called with the data of a read.
  using ReadDone = std::function<void(std::uint32_t data)>;
  /// An access of user logic, as soon as its port is ready, in the order of the calls.
  void access(const UserAccess &access, ReadDone done = {}) {
    disturbed();
    accesses_.push_back({access, std::move(done)});
  }
  void user_write(unsigned index, std::uint32_t data, unsigned lanes) override {
    access({true, lanes, index, data});
  }
  /// Accesses that wait.
  [[nodiscard]] std::size_t waiting() const { return accesses_.size(); }
  /// usr_ready_o.
  [[nodiscard]] virtual bool ready() const = 0;
  /// What user logic would read in words `first` .. `first + n - 1` now. Nothing happens to the
  /// node: it is done on a copy.
  [[nodiscard]] virtual std::vector<std::uint32_t> peek_words(unsigned first, unsigned n) const = 0;

  /// The frame on the bus as far as the engine has handed it out; whole in the clock of rx_valid_o
  /// or tx_ok_o.
  [[nodiscard]] virtual const Frame &frame() const = 0;

  /// Called when an access has been carried out, before its ReadDone.
  std::function<void(const UserAccess &)> on_access;
  /// Called in each clock in which a millisecond ends.
  std::function<void()> on_ms;

 protected:
  RemoteNode(std::string name, const ClockConfig &clock) : RemoteUnit{std::move(name), clock} {}

  struct Waiting {
    UserAccess access;
    ReadDone done;
  };
  std::deque<Waiting> accesses_;
};

}  // namespace vericansim
