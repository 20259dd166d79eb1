// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CanPort: a way by which programs of the host reach the simulated bus, each the CAN interface of
// one node.
#pragma once

#include <linux/can.h>
#include <poll.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

/// A message between the programs of the host and a node of the bus.
struct PortMessage {
  /// Nobody in particular: messages from the bus, and ports that do not tell programs apart.
  static constexpr std::uint64_t kNobody = 0;

  can_frame frame{};  ///< SocketCAN's form, flags in can_id; CAN_ERR_FLAG: an error message
  Time time = 0;      ///< from the bus: simulated time of the end of the frame, or of the event, ps
  /// From the host: who sent it. To the host: who had sent the frame that has now left (echo);
  /// that program itself does not get it, unless it asked for its own messages.
  std::uint64_t client = kNobody;
  bool echo = false;  ///< to the host: a frame that this port's own node has sent
};

/// The interface. One thread; nothing blocks. The bridge polls the descriptors of all its ports
/// between two stretches of simulation and hands them to service().
class CanPort {
 public:
  virtual ~CanPort() = default;

  /// What users call it, for example "vcan0".
  [[nodiscard]] virtual const std::string &name() const = 0;
  /// Appends what to poll for. `wants_room`: the bridge has a message that put() refused.
  virtual void poll_set(std::vector<pollfd> &set, bool wants_room) = 0;
  /// Looks after connections, with what poll() said of this port's part of the set.
  virtual void service(std::span<const pollfd> ready) = 0;
  /// The next message of a program, in their order; empty if there is none now. The bridge takes
  /// only what it has room for: what is not taken waits, and in the end the programs wait.
  [[nodiscard]] virtual std::optional<PortMessage> take() = 0;
  /// At the end: messages of programs that have not been taken.
  [[nodiscard]] virtual std::size_t remaining() { return 0; }
  /// Hands a message to the programs. False: no room now; the bridge keeps it and tries again.
  [[nodiscard]] virtual bool put(const PortMessage &message) = 0;
  /// False while nobody can be reached (interface down or gone); the bridge keeps its state.
  [[nodiscard]] virtual bool up() const = 0;
  /// Simulated time is now `now`, counted as in PortMessage; called once a round, before
  /// poll_set().
  virtual void tick(Time now) { (void)now; }
  /// True: the port will do something at a later simulated time, so time has to go on.
  [[nodiscard]] virtual bool awaits_time() const { return false; }
  /// True: the programs want to hear of their own frames when these have really left (echo).
  [[nodiscard]] virtual bool wants_echo() const { return false; }
  /// Messages that were lost on the way from a program to take(), where the operating system says
  /// so.
  [[nodiscard]] virtual std::uint64_t lost() const { return 0; }
};

}  // namespace vericansim
