// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RawCanPort: a CAN interface of the kernel, through a raw socket.
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "can_port.hpp"
#include "session/pacer.hpp"

namespace vericansim {

/// What to do where no CAN socket can be opened: socket() has set errno to `error`.
[[nodiscard]] std::string can_socket_problem(int error);

/// How a RawCanPort treats its interface.
struct RawPortOptions {
  bool echo = false;     ///< tell the programs when their frames have really left
  bool receives = true;  ///< false: a port to listen at alone; what programs send there is ignored
  std::string option = "--if";  ///< by which the user has named the interface
  std::size_t queue = 100'000;  ///< frames of programs that wait here at most
};

/// A CAN interface: vcan, vxcan or hardware. A vcan never lets its programs wait, so the port reads
/// ahead what the node has no room for, up to `queue` frames; what comes then waits in the socket's
/// buffer, and what the kernel drops there is counted by lost().
///
/// Frames that the port itself has written do not come back (CAN_RAW_RECV_OWN_MSGS off). While the
/// interface is down or gone, up() is false; the port looks for it ten times a second and binds
/// itself again.
class RawCanPort : public CanPort {
 public:
  /// Throws InputError with what to do if the kernel has no CAN, there is no such interface, it is
  /// no CAN interface, it is down, or it may not be used.
  RawCanPort(std::string interface, const RawPortOptions &options);
  ~RawCanPort() override;
  RawCanPort(const RawCanPort &) = delete;
  RawCanPort &operator=(const RawCanPort &) = delete;

  [[nodiscard]] const std::string &name() const override { return name_; }
  void poll_set(std::vector<pollfd> &set, bool wants_room) override;
  void service(std::span<const pollfd> ready) override;
  [[nodiscard]] std::optional<PortMessage> take() override;
  [[nodiscard]] std::size_t remaining() override;
  [[nodiscard]] bool put(const PortMessage &message) override;
  [[nodiscard]] bool up() const override { return up_; }
  [[nodiscard]] bool wants_echo() const override { return options_.echo; }
  [[nodiscard]] std::uint64_t lost() const override;

 private:
  void open_socket();
  void read_ahead();
  bool read_one();
  void went_down();
  void look_again();

  std::string name_;
  RawPortOptions options_;
  int fd_ = -1;
  int index_ = 0;
  bool up_ = false;
  WallTime next_look_ = 0;
  std::deque<can_frame> waiting_;
};

}  // namespace vericansim
