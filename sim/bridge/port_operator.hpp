// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PortOperator, MonitorOperator: programs of the host as a node of a session, and as listeners.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "can_port.hpp"
#include "port_node.hpp"
#include "session/operator.hpp"

namespace vericansim {

/// A port as a session's outlet, with the messages that wait for its programs.
class PortOutlet : public Outlet {
 public:
  /// Messages that may wait for the programs of one port before simulated time stands still.
  static constexpr std::size_t kMostWaiting = 4096;

  PortOutlet(std::shared_ptr<CanPort> port, bool ends_when_down)
      : port_{std::move(port)}, ends_when_down_{ends_when_down} {}

  [[nodiscard]] const std::string &name() const override { return port_->name(); }
  void tick(Time now) override { port_->tick(now); }
  void poll_set(std::vector<pollfd> &set, bool wants_room) override {
    port_->poll_set(set, wants_room);
  }
  void service(std::span<const pollfd> ready) override { port_->service(ready); }
  [[nodiscard]] bool awaits_time() const override { return port_->awaits_time(); }
  [[nodiscard]] bool up() const override { return port_->up(); }
  [[nodiscard]] bool ends_when_down() const override { return ends_when_down_; }
  void close(RunReport &report) override {
    if (on_close) on_close(report);
  }

  /// When the session is over and all has been given.
  std::function<void(RunReport &)> on_close;

 protected:
  [[nodiscard]] CanPort &port() { return *port_; }
  [[nodiscard]] const CanPort &port() const { return *port_; }

 private:
  std::shared_ptr<CanPort> port_;
  bool ends_when_down_;
};

/// A node of the bus that is a port's.
class PortOperator : public Operator, public PortOutlet {
 public:
  PortOperator(const OperatorContext &context, std::shared_ptr<CanPort> port,
               const PortOptions &options, bool ends_when_down);

  void start() override { node_.start(); }
  [[nodiscard]] bool ready() const override { return node_.ready(); }
  void check() override { node_.check(); }
  [[nodiscard]] bool wants_bits() const override { return true; }
  void on_bit(const BitRecord &bit) override { node_.on_bit(bit); }
  [[nodiscard]] bool idle() const override { return node_.quiet(); }
  [[nodiscard]] Outlet *outlet() override { return this; }
  void report(RunReport &report) override;

  bool give() override { return node_.give(); }
  void take() override { node_.take(); }
  [[nodiscard]] bool stalled() const override { return node_.waiting() > kMostWaiting; }
  void restart() override { node_.restart(); }

 private:
  NodeId id_;
  PortNode node_;
};

/// A port that gets all that is on the bus, in its order, and sends nothing.
class MonitorOperator : public Operator, public PortOutlet {
 public:
  MonitorOperator(std::shared_ptr<CanPort> port, ErrorChoice errors, bool ends_when_down)
      : PortOutlet{std::move(port), ends_when_down}, errors_{errors} {}

  void on_frame(const BusFrame &frame) override;
  void on_event(const BusEvent &event) override;
  [[nodiscard]] Outlet *outlet() override { return this; }
  void report(RunReport &report) override;

  bool give() override { return box_.give_to(port(), counts_); }
  void take() override {}
  [[nodiscard]] bool stalled() const override { return box_.size() > kMostWaiting; }

 private:
  ErrorChoice errors_;
  Outbox box_;
  PortCounts counts_;
};

}  // namespace vericansim
