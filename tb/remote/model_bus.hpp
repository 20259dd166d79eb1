// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ModelBus: models of remote nodes and the C client on a bus of whole frames with a clock of its
// own.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "model/remote_model.hpp"
#include "verican_remote.h"

namespace vericansim {

/// A bus on which a frame takes 130 us. The client's frames go first, nodes' frames by identifier;
/// with a latency those of the nodes get in between.
class ModelBus {
 public:
  /// A frame that is on its way to somebody; false: it is lost for the node (nullptr: the host).
  using Filter = std::function<bool(const RemoteModel *to, const Frame &frame)>;

  /// Adds a node, started.
  RemoteModel &add(const RemoteConfig &config, unsigned number);
  /// The three functions of the client; this must outlive it.
  [[nodiscard]] verican_remote_port_t port();

  /// A frame of the host's goes over the bus, as often as `repeat` says, then what nodes say.
  void send(const Frame &frame);
  /// Time passes; nodes may say something.
  void wait(std::uint32_t us);

  [[nodiscard]] std::uint32_t now() const { return now_us_; }
  [[nodiscard]] RemoteModel &node(std::size_t i) { return *nodes_.at(i); }
  /// Frames of the host, and of the nodes, since the last call; as candump writes them.
  [[nodiscard]] std::vector<std::string> take_sent();
  [[nodiscard]] std::vector<std::string> take_said();

  Filter filter = [](const RemoteModel *, const Frame &) { return true; };
  unsigned repeat = 1;           ///< how often each of the host's frames is on the bus
  std::uint32_t latency_us = 0;  ///< from a call of the client to the frame on the bus
  unsigned doubled = 1;          ///< how often the host receives each of the nodes' frames (VA-03)
  /// What the host receives of a node's frame.
  std::function<Frame(Frame)> heard = [](Frame frame) { return frame; };
  bool bus_off = false;  ///< the host is off the bus
  /// Different frames of one identifier destroy each other, as between error active nodes (RN-10,
  /// RN-15). Else one goes after the other, as between error passive ones.
  bool collides = false;

 private:
  verican_remote_result_t receive(verican_remote_frame_t &frame, std::uint32_t timeout_us);
  bool send_waiting();
  bool step();
  bool collide(const Frame &frame);
  void deliver(const Frame &frame, const RemoteModel *sender);

  std::vector<std::unique_ptr<RemoteModel>> nodes_;
  std::deque<Frame> to_host_;
  std::deque<std::pair<std::uint32_t, Frame>> from_host_;  // and when they reach the bus
  std::vector<std::string> sent_;
  std::vector<std::string> said_;
  std::uint32_t now_us_ = 0xFFFF0000;  // wraps soon
  std::uint32_t tick_us_ = 0;
};

}  // namespace vericansim
